import assert from 'node:assert/strict';
import {test} from 'node:test';
import {FrameBuffer, PlayoutClock} from '../../../server/page/playout.js';

const liveTiming = {windowMs: 4e3, maxJitterMs: 400, farMs: 600};
const keptMs = 5 * 60e3;

// A frame with player 0 at (x, 0, 0), looked at by camera 5 at the same place.
function frame(t, x, {flags = 2, playerFlags = 1, target = 0, epoch} = {}) {
    const place = {position: [x, 0, 0], rotation: [0, 0, 0, 1]};
    return {t, epoch, players: new Map([[0, {slot: 0, flags: playerFlags, ...place}]]),
        cameras: new Map([[5, {id: 5, target, flags, fov: 1, ...place}]]), movers: new Map([[9, place]])};
}

const add = (buffer, data) => buffer.add(data.t, 64, () => data);

function filled(...frames) {
    const buffer = new FrameBuffer(keptMs);
    for (const data of frames) assert.ok(add(buffer, data));
    return buffer;
}

test('between two frames things move evenly', () => {
    const buffer = filled(frame(100, 0), frame(120, 10));
    for (const [t, x] of [[100, 0], [105, 2.5], [110, 5], [120, 10]]) {
        const sample = buffer.sample(t);
        assert.equal(sample.players.get(0).position[0], x);
        assert.equal(sample.cameras.get(5).position[0], x);
        assert.equal(sample.movers.get(9).position[0], x);
    }
    assert.equal(buffer.sample(90).players.get(0).position[0], 0, 'before the first');
    assert.equal(buffer.sample(900).players.get(0).position[0], 10, 'after the last');
});

test('a cut is not interpolated, a jump of a player neither', () => {
    const at = (options, cut) => filled(frame(100, 0), frame(120, 10, options)).sample(115, cut);
    assert.equal(at({flags: 3}).cameras.get(5).position[0], 0);
    assert.equal(at({flags: 3}).players.get(0).position[0], 7.5);
    assert.equal(at({playerFlags: 3}).players.get(0).position[0], 0);
    assert.equal(at({target: 1}).cameras.get(5).position[0], 0);
    assert.equal(at({epoch: 2}).players.get(0).position[0], 0, 'another epoch');
    assert.equal(at({}, (id, from, to) => id === 5 && from === 100 && to === 120).cameras.get(5).position[0], 0,
        'a cut whose frame was dropped');
});

test('a mover that is gone from the next frame stands where it was', () => {
    const buffer = filled(frame(100, 0), {...frame(120, 10), movers: new Map()});
    assert.equal(buffer.sample(110).movers.get(9).position[0], 0);
    assert.equal(buffer.sample(120).movers.size, 0);
});

test('over a long gap nothing moves', () => {
    assert.equal(filled(frame(100, 0), frame(500, 10)).sample(400).players.get(0).position[0], 0);
});

test('it tells how long nothing follows', () => {
    const buffer = filled(frame(100, 0), frame(120, 10), frame(5000, 0));
    assert.equal(buffer.silenceAfter(110, 2000), null);
    assert.equal(buffer.silenceAfter(120, 2000), 5000);
    assert.equal(buffer.silenceAfter(4000, 2000), 5000);
    assert.equal(buffer.silenceAfter(4000, 9000), null);
    assert.equal(buffer.silenceAfter(5000, 2000), null, 'the end is no silence');
    assert.equal(new FrameBuffer(keptMs).silenceAfter(0, 1), null);
});

test('the buffer is bounded and takes frames in order', () => {
    const buffer = filled(frame(100, 0));
    assert.ok(!add(buffer, frame(100, 0)));
    assert.ok(!add(buffer, frame(50, 0)));
    for (let t = 120; t < 800e3; t += 20) add(buffer, frame(t, 0));
    assert.ok(buffer.last - buffer.first <= 5 * 60e3);
    assert.ok(buffer.frames.length > 14000);
    assert.equal(buffer.bytes, buffer.frames.length * 64);
});

test('what is needed is kept however much it takes', () => {
    const buffer = new FrameBuffer(keptMs, 640);
    const addUntil = (last, neededFrom) => {
        for (let t = (buffer.last ?? 0) + 20; t <= last; t += 20) buffer.add(t, 64, () => frame(t, 0), neededFrom);
    };
    addUntil(400, Infinity);
    assert.deepEqual([buffer.first, buffer.last], [220, 400]);
    addUntil(1000, 310);
    assert.deepEqual([buffer.first, buffer.last], [300, 1000], 'with the frame before it, which it is interpolated from');
    assert.ok(!buffer.hasRoomAfter(310));
    assert.ok(buffer.hasRoomAfter(900));
    addUntil(1020, 900);
    assert.equal(buffer.bytes, 640);
});

// Plays 60 frames a second for some seconds; frames arrive with this delay.
function play(clock, seconds, delayOf, start = 0) {
    const shown = [];
    let arrived = 0;
    for (let now = start; now < start + seconds * 1000; now += 1000 / 60) {
        while (arrived * 20 + delayOf(arrived) <= now - start) {
            clock.arrived(start + arrived * 20, now);
            ++arrived;
        }
        clock.advance(now, arrived > 0 ? start : null, start + (arrived - 1) * 20);
        shown.push(clock.t);
    }
    return shown;
}

test('live playing is even although arrivals are not', () => {
    let seed = 7;
    const jitter = () => (seed = seed * 48271 % 2147483647) % 60;
    const delays = Array.from({length: 600}, jitter);
    const shown = play(new PlayoutClock(liveTiming), 10, i => 50 + delays[i]).slice(200);
    for (let i = 1; i < shown.length; ++i) {
        const moved = shown[i] - shown[i - 1];
        assert.ok(moved > 14 && moved < 19.5, `moved ${moved} ms in a frame of 16.7 ms`);
    }
});

test('the clock goes on after a stall, and never beyond what has arrived', () => {
    const clock = new PlayoutClock(liveTiming);
    play(clock, 5, () => 50);
    clock.advance(20e3, 0, 4900);
    assert.ok(clock.t <= 4900);
    clock.arrived(20e3, 20e3 + 50);
    clock.advance(20e3 + 60, 0, 20e3);
    clock.advance(20e3 + 76, 0, 20e3);
    assert.ok(clock.t > 19e3, 'it jumps to what is live');
});

test('a viewer pauses, scrubs, plays and comes back', () => {
    const clock = new PlayoutClock(liveTiming);
    play(clock, 5, () => 50);
    const live = clock.t;
    clock.setPaused(true);
    clock.advance(5500, 0, 5400);
    assert.equal(clock.t, live);
    clock.seek(1000);
    clock.advance(6000, 0, 5900);
    assert.equal(clock.t, 1000, 'still paused');
    clock.setPaused(false);
    clock.advance(6100, 0, 6000);
    assert.equal(clock.t, 1100);
    clock.advance(6200, 2000, 6100);
    assert.equal(clock.t, 2000, 'what was before is forgotten');
    clock.goLive();
    assert.ok(clock.live && clock.t > 5000);
});

test('a recording is played at a speed, to its end', () => {
    const clock = new PlayoutClock(liveTiming);
    clock.seek(0);
    clock.advance(1000, 0, 500, false);
    clock.setSpeed(4);
    clock.advance(1050, 0, 500, false);
    assert.equal(clock.t, 200);
    clock.hold(2000);
    clock.advance(2010, 0, 500, false);
    assert.equal(clock.t, 240, 'it stood still');
    clock.advance(2900, 0, 500, false);
    assert.ok(clock.t === 500 && !clock.live, 'more may follow');
    clock.advance(2910, 0, 500, true);
    assert.ok(clock.live && clock.speed === 1, 'what is newest is live');
});
