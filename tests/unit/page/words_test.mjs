import assert from 'node:assert/strict';
import {test} from 'node:test';
import {clockText, stateText} from '../../../server/page/words.js';

test('times are read as clocks', () => {
    for (const [ms, text] of [[0, '0:00.0'], [75540, '1:15.5'], [-5, '0:00.0'], [3600e3 + 65e3, '1:01:05.0'], [599999, '9:59.9']])
        assert.equal(clockText(ms), text);
    assert.equal(clockText(75540, false), '1:15');
});

test('only what is live is called so', () => {
    const facts = {retryInMs: 1600, known: true, entry: 'running', behindMs: 2500, lateMs: 12500};
    const of = (state, more) => stateText(state, {...facts, ...more});
    assert.deepEqual(of('live'), ['live', 'Live · 12.5 s after the game']);
    assert.deepEqual(of('live', {lateMs: null}), ['live', 'Live · 2.5 s after the game']);
    const others = {none: 'No match', outdated: 'Another version: reload this page', waiting: 'Reconnecting in 2 s',
        connecting: 'Reconnecting', opening: 'Opening', loading: 'Loading', ended: 'Ended', silent: 'No frames: running',
        empty: 'running', paused: 'Paused, 2.5 s behind', behind: '2.5 s behind', playing: 'Recording, 0:02 behind'};
    for (const [state, text] of Object.entries(others)) {
        assert.equal(of(state)[1], text);
        assert.notEqual(of(state)[0], 'live', state);
    }
    assert.equal(of('playing', {behindMs: null})[1], 'Recording');
    assert.equal(of('paused', {behindMs: null})[1], 'Paused');
    assert.equal(of('connecting', {known: false})[1], 'Connecting');
    assert.equal(of('waiting', {isFull: true})[1], 'No room for another viewer: trying again in 2 s');
});
