import assert from 'node:assert/strict';
import {test} from 'node:test';
import {Timeline} from '../../../server/page/timeline.js';

const visible = 2;
const searching = 4;
const frame = (t, ...cameras) => ({t, cameras: new Map(cameras.map(([id, target, flags]) => [id, {id, target, flags}]))});

test('a shot has a span for each state', () => {
    const timeline = new Timeline();
    timeline.addFrame(frame(0, [5, 1, visible | 1]));
    timeline.addFrame(frame(20, [5, 1, visible]));
    timeline.addFrame(frame(40, [5, 1, searching]));
    timeline.addFrame(frame(60, [5, 2, searching]));
    timeline.addFrame(frame(80));
    timeline.addFrame(frame(100));
    assert.deepEqual(timeline.spans(5, 0, 200), [
        {from: 0, to: 40, target: 1, flags: visible},
        {from: 40, to: 60, target: 1, flags: searching},
        {from: 60, to: 80, target: 2, flags: searching},
    ]);
    assert.deepEqual(timeline.spans(5, 50, 55), [{from: 50, to: 55, target: 1, flags: searching}]);
    assert.deepEqual(timeline.spans(6, 0, 200), []);
});

test('history comes first, frames go on from it', () => {
    const timeline = new Timeline();
    const cut = {kind: 'cut', t: 10, camera: 5, target: 0, reason: 'begin'};
    timeline.addHistory({states: [[10, 5, 0, visible], [20, 5, 0, searching]], notes: [cut, {kind: 'event', t: 15, event: 'kill'}]});
    timeline.addFrame(frame(20, [5, 0, searching]));
    timeline.addFrame(frame(40, [5, 0, visible]));
    assert.equal(timeline.spans(5, 0, 50).length, 3);
    assert.deepEqual(timeline.cuts, [cut]);
    assert.equal(timeline.events.length, 1);
    assert.ok(timeline.cutBetween(5, 0, 10));
    assert.ok(!timeline.cutBetween(5, 10, 20), 'cuts belong to the frame at their end');
    assert.ok(!timeline.cutBetween(6, 0, 10));
    assert.deepEqual(timeline.cutBefore(5, 30), cut);
    assert.equal(timeline.cutBefore(5, 5), null);
});

test('what is older than five minutes is forgotten', () => {
    const timeline = new Timeline();
    timeline.addNote({kind: 'cut', t: 5, camera: 5});
    timeline.addNote({kind: 'event', t: 5, event: 'kill'});
    timeline.addFrame(frame(0, [5, 1, visible], [6, 1, visible]));
    timeline.addFrame(frame(20, [5, 1, visible]));
    timeline.addFrame(frame(400e3, [5, 1, visible]));
    assert.equal(timeline.cuts.length + timeline.events.length, 0);
    assert.deepEqual([...timeline.shots.keys()], [5], 'a shot that ended long ago');
    assert.equal(timeline.spans(5, 300e3, 400e3).length, 1, 'a long state is known still');
});

test('it is bounded whatever happens', () => {
    const timeline = new Timeline();
    for (let i = 0; i < 20000; ++i) {
        timeline.addState(i, 5, 0, i % 2 ? visible : searching);
        timeline.addNote({kind: 'cut', t: i, camera: 5});
    }
    assert.ok(timeline.shots.get(5).length <= 4096);
    assert.ok(timeline.cuts.length <= 1024);
});
