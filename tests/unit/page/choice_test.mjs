// What the page watches, as the list of matches changes.
import assert from 'node:assert/strict';
import {test} from 'node:test';
import {choose, isFull, maxRefusals} from '../../../server/page/choice.js';

const live = (id, more = {}) => ({id, stream: {shots: []}, sync: null, goesOn: true, ...more});
const broadcast = (id, goesOn = true) => ({id, stream: null, sync: `${id}/sync`, goesOn});
const watching = more => ({id: 'a', isRecorded: false, hasEnded: false, isOpen: true, missed: 0, refusals: 0, ...more});
const nothing = watching({id: null, isOpen: false});

test('it begins with a match that has a camera, else with one that goes on', () => {
    assert.equal(choose([], nothing), null);
    assert.equal(choose([broadcast('old', false), live('b')], nothing).id, 'b');
    assert.equal(choose([live('b'), live('c', {stream: {shots: [{}]}})], nothing).id, 'c');
    assert.equal(choose([broadcast('old', false)], nothing).id, 'old');
});

test('a list that lacks the stream which runs changes nothing, whether the match is broadcast or not', () => {
    for (const a of [[], [broadcast('a')]])
        assert.equal(choose([...a, live('b')], watching({missed: 100})), null);
});

test('a stream that is lost is waited for, for some lists', () => {
    const lost = missed => choose([live('b')], watching({isOpen: false, missed}));
    assert.equal(lost(4), null);
    assert.deepEqual(lost(5), {id: 'b', from: 'newest'});
    assert.equal(choose([], watching({isOpen: false, missed: 100})), null, 'there is no other');
});

test('after the end of a match it goes on with what follows', () => {
    const ended = watching({hasEnded: true, isOpen: false});
    assert.equal(choose([live('b')], ended).id, 'b');
    assert.equal(choose([live('b'), live('a')], ended).id, 'a', 'the next of that name');
    assert.equal(choose([broadcast('b')], ended), null);
});

test('a recording is stayed with until it has ended and another one of that match begins', () => {
    const recorded = more => watching({isRecorded: true, isOpen: false, ...more});
    assert.equal(choose([live('b')], recorded({missed: 100})), null);
    assert.equal(choose([broadcast('a')], recorded({})), null);
    assert.equal(choose([broadcast('a')], recorded({hasEnded: true})).id, 'a');
    assert.equal(choose([broadcast('a', false)], recorded({hasEnded: true})), null);
});

test('whom a server has no room for watches the broadcast where there is one', () => {
    const refused = watching({isOpen: false, refusals: maxRefusals});
    assert.deepEqual(choose([live('a', {sync: 'a/sync'})], refused), {id: 'a', from: 'broadcast'});
    assert.equal(choose([live('a')], refused), null);
    assert.equal(choose([live('a', {sync: 'a/sync'})], {...refused, refusals: maxRefusals - 1}), null);
});

test('a match that the server does not have yet is not one for which it has no room', () => {
    assert.ok(isFull(live('a'), maxRefusals));
    assert.ok(!isFull(undefined, 100));
    assert.ok(!isFull(broadcast('a'), 100));
});
