import assert from 'node:assert/strict';
import {test} from 'node:test';
import {Timeline} from '../../../server/page/timeline.js';

const visible = 2;
const searching = 4;
const live = {keptMs: 5 * 60e3, maxStates: 4096, maxMarks: 1024};
const whole = {keptMs: Infinity, maxStates: 65536, maxMarks: 65536};
const frame = (t, ...cameras) => ({t, cameras: new Map(cameras.map(([id, target, flags]) => [id, {id, target, flags}]))});

test('a shot has a span for each state', () => {
    const timeline = new Timeline(live);
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

test('of each quarter of a second the greatest latency is kept, and after a history too', () => {
    const timeline = new Timeline({...live, keptMs: 1000});
    for (const [t, ms] of [[0, 20], [16, 45], [240, 30], [260, 10], [2000, 7]]) timeline.addLatency(t, ms);
    timeline.clear();
    assert.deepEqual(timeline.latencies, [{t: 0, ms: 45}, {t: 260, ms: 10}, {t: 2000, ms: 7}]);
    assert.equal(timeline.latencyAt(100), 45);
    assert.equal(timeline.latencyAt(505), 10);
    assert.equal(timeline.latencyAt(1000), null, 'no frame arrived');
    assert.equal(timeline.latencyAt(-1), null);
    timeline.addFrame(frame(2016));
    assert.deepEqual(timeline.latencies, [{t: 2000, ms: 7}]);
});

test('history comes first, frames go on from it', () => {
    const timeline = new Timeline(live);
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
    const timeline = new Timeline(live);
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
    const timeline = new Timeline(live);
    for (let i = 0; i < 20000; ++i) {
        timeline.addState(i, 5, 0, i % 2 ? visible : searching);
        timeline.addNote({kind: 'cut', t: i, camera: 5});
        timeline.addNote({kind: 'event', t: i, event: i === 0 ? 'kill' : 'damage'});
    }
    assert.deepEqual(timeline.events, [{kind: 'event', t: 0, event: 'kill'}], 'only what the page shows');
    assert.ok(timeline.shots.get(5).length <= 4096);
    assert.ok(timeline.cuts.length <= 1024);
});

// Parts of a recording: four of 3 s, in which camera 5 sees player 1, loses it at `lostAt` and is gone at 8 s. The frames of
// each are so much earlier than its records.
function parts({earlyMs = 0, lostAt = 4000} = {}) {
    return [0, 1, 2, 3].map(n => {
        const part = new Timeline(whole);
        for (let t = n * 3000 - earlyMs; t < (n + 1) * 3000 - earlyMs; t += 100)
            part.addFrame(t < 8000 ? frame(t, [5, 1, t < lostAt ? visible : searching]) : frame(t));
        part.addNote({kind: 'cut', t: n * 3000, camera: 5, target: 1, reason: 'begin'});
        part.addNote({kind: 'event', t: n * 3000 + 5, event: 'kill'});
        part.addNote({kind: 'event', t: n * 3000 + 1, event: 'award'});
        part.addLatency(n * 3000, n);
        return {part, end: n * 3000 + 2900 + earlyMs};
    });
}

test('parts make the same timeline in any order', () => {
    const inOrder = new Timeline(whole);
    for (const {part, end} of parts()) inOrder.insert(part, end);
    assert.deepEqual(inOrder.spans(5, 0, 12000), [
        {from: 0, to: 4000, target: 1, flags: visible},
        {from: 4000, to: 8000, target: 1, flags: searching},
    ]);
    assert.deepEqual(inOrder.cuts.map(cut => cut.t), [0, 3000, 6000, 9000]);
    assert.deepEqual(inOrder.events.map(event => event.t), [1, 5, 3001, 3005, 6001, 6005, 9001, 9005]);
    for (const order of [[3, 2, 1, 0], [2, 0, 3, 1], [1, 3, 0, 2]]) {
        const timeline = new Timeline(whole);
        for (const n of order) timeline.insert(parts()[n].part, parts()[n].end);
        assert.deepEqual(timeline.spans(5, 0, 12000), inOrder.spans(5, 0, 12000), `${order}`);
        assert.deepEqual(timeline.cuts, inOrder.cuts);
        assert.deepEqual(timeline.events, inOrder.events);
        assert.deepEqual(timeline.latencies, [0, 1, 2, 3].map(n => ({t: n * 3000, ms: n})));
    }
});

const orders = [[0, 1, 2, 3], [3, 2, 1, 0], [2, 0, 3, 1], [1, 3, 0, 2]];

test('parts that overlap a little leave nothing out', () => {
    for (const earlyMs of [10, 90, 110]) for (const order of orders) {
        const timeline = new Timeline(whole);
        const all = parts({earlyMs});
        for (const n of order) timeline.insert(all[n].part, all[n].end);
        const seen = timeline.spans(5, 0, 12000);
        assert.deepEqual(seen.map(({flags}) => flags), [visible, searching], `${earlyMs} ms, ${order}`);
        assert.equal(seen[0].to, seen[1].from);
        assert.ok(seen[0].from === 0 && seen[0].to >= 4000 && seen[0].to < 4100 && seen[1].to >= 8000 && seen[1].to < 8100);
    }
});

test('a last part of some frames follows on, in either order', () => {
    const part = (from, to) => {
        const timeline = new Timeline(whole);
        timeline.addState(from, 5, 1, visible);
        return [timeline, to];
    };
    for (const order of [[0, 1], [1, 0]]) {
        const all = [part(0, 3000), part(3010, 3220)];
        const timeline = new Timeline(whole);
        for (const n of order) timeline.insert(...all[n]);
        assert.deepEqual(timeline.spans(5, 0, 9000).map(({from, to}) => [from, to]), [[0, 3220]], order);
    }
});

test('where states of parts that overlap alternate, each part is known still', () => {
    for (const order of orders) {
        const timeline = new Timeline(whole);
        const all = parts({lostAt: 6000}).map((each, n) => {
            each.part.addState(n * 3000 + 3003, 5, 1, 0);
            return {...each, end: n * 3000 + 3005};
        });
        for (const n of order) timeline.insert(all[n].part, all[n].end);
        const states = timeline.shots.get(5);
        assert.ok(states.every(({t}, i) => i === 0 || t >= states[i - 1].t), `${order}: ${states.map(({t}) => t)}`);
        for (let t = 50; t < 8000; t += 100)
            assert.ok(timeline.spans(5, t, t + 1).some(({flags}) => flags === (t < 6000 ? visible : searching)), `${order}: ${t}`);
    }
});

test('events that are told late are in order, whatever part comes first', () => {
    const told = [[1000, 2000, 2900], [2500, 5000], [5900, 7000]];
    for (const order of [[0, 1, 2], [2, 1, 0], [1, 0, 2]]) {
        const timeline = new Timeline(whole);
        for (const n of order) {
            const part = new Timeline(whole);
            for (const t of told[n]) part.addNote({kind: 'event', t, event: 'kill'});
            timeline.insert(part, n * 3000 + 2999);
        }
        assert.deepEqual(timeline.events.map(({t}) => t), [1000, 2000, 2500, 2900, 5000, 5900, 7000]);
    }
});

test('between parts nothing is known', () => {
    const timeline = new Timeline(whole);
    for (const n of [2, 0]) timeline.insert(parts()[n].part, parts()[n].end);
    assert.deepEqual(timeline.spans(5, 0, 12000).map(({from, to}) => [from, to]), [[0, 2900], [6000, 8000]]);
    assert.deepEqual(timeline.spans(5, 2950, 5950), []);
    assert.equal(timeline.cutAfter(5, 0).t, 6000);
    assert.equal(timeline.cutAfter(5, 6000), null);
});
