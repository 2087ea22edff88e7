import assert from 'node:assert/strict';
import {test} from 'node:test';
import {FrameBuffer, PlayoutClock} from '../../../server/page/playout.js';

// A frame with player 0 at (x, 0, 0), looked at by camera 5 at the same place.
function frame(t, x, {flags = 2, playerFlags = 1, target = 0} = {}) {
    const buffer = new ArrayBuffer(28 + 14 + 22);
    const view = new DataView(buffer);
    view.setUint8(0, 1);
    view.setUint16(2, 1, true);
    view.setUint16(4, 1, true);
    view.setBigInt64(12, BigInt(Math.round(t * 1e6)), true);
    view.setUint8(28 + 1, playerFlags);
    view.setUint32(30, x, true);
    view.setUint32(38, (3 << 30 | 511 << 20 | 511 << 10 | 511) >>> 0, true);
    view.setUint32(42, 5, true);
    view.setUint8(46, target);
    view.setUint8(47, flags);
    view.setUint32(50, x, true);
    view.setUint16(62, 3 << 13, true);
    return buffer;
}

function filled(...frames) {
    const buffer = new FrameBuffer();
    for (const data of frames) assert.ok(buffer.add(data));
    return buffer;
}

test('between two frames things move evenly', () => {
    const buffer = filled(frame(100, 0), frame(120, 10));
    for (const [t, x] of [[100, 0], [105, 2.5], [110, 5], [120, 10]]) {
        const sample = buffer.sample(t, 1);
        assert.equal(sample.players.get(0).position[0], x);
        assert.equal(sample.cameras.get(5).position[0], x);
    }
    assert.equal(buffer.sample(90, 1).players.get(0).position[0], 0, 'before the first');
    assert.equal(buffer.sample(900, 1).players.get(0).position[0], 10, 'after the last');
});

test('a cut is not interpolated, a jump of a player neither', () => {
    const at = (options, cut) => filled(frame(100, 0), frame(120, 10, options)).sample(115, 1, cut);
    assert.equal(at({flags: 3}).cameras.get(5).position[0], 0);
    assert.equal(at({flags: 3}).players.get(0).position[0], 7.5);
    assert.equal(at({playerFlags: 3}).players.get(0).position[0], 0);
    assert.equal(at({target: 1}).cameras.get(5).position[0], 0);
    assert.equal(at({}, (id, from, to) => id === 5 && from === 100 && to === 120).cameras.get(5).position[0], 0,
        'a cut whose frame was dropped');
});

test('over a long gap nothing moves', () => {
    assert.equal(filled(frame(100, 0), frame(500, 10)).sample(400, 1).players.get(0).position[0], 0);
});

test('the buffer is bounded and takes frames in order', () => {
    const buffer = filled(frame(100, 0));
    assert.ok(!buffer.add(frame(100, 0)));
    assert.ok(!buffer.add(frame(50, 0)));
    assert.ok(!buffer.add(new ArrayBuffer(3)));
    for (let t = 120; t < 800e3; t += 20) buffer.add(frame(t, 0));
    assert.ok(buffer.last - buffer.first <= 5 * 60e3);
    assert.ok(buffer.frames.length > 14000);
    assert.equal(buffer.bytes, buffer.frames.length * 64);
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
    const shown = play(new PlayoutClock(), 10, i => 50 + delays[i]).slice(200);
    for (let i = 1; i < shown.length; ++i) {
        const moved = shown[i] - shown[i - 1];
        assert.ok(moved > 14 && moved < 19.5, `moved ${moved} ms in a frame of 16.7 ms`);
    }
});

test('the clock goes on after a stall, and never beyond what has arrived', () => {
    const clock = new PlayoutClock();
    play(clock, 5, () => 50);
    clock.advance(20e3, 0, 4900);
    assert.ok(clock.t <= 4900);
    clock.arrived(20e3, 20e3 + 50);
    clock.advance(20e3 + 60, 0, 20e3);
    clock.advance(20e3 + 76, 0, 20e3);
    assert.ok(clock.t > 19e3, 'it jumps to what is live');
});

test('a viewer pauses, scrubs, plays and comes back', () => {
    const clock = new PlayoutClock();
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
