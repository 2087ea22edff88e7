import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {test} from 'node:test';
import {cameraFlag, decodeFrame} from '../../../server/page/protocol.js';

// What the server's tests encode.
function golden() {
    const hex = readFileSync(new URL('../live/frame.hex', import.meta.url), 'utf8').trim();
    return Uint8Array.from(hex.match(/../g), byte => parseInt(byte, 16)).buffer;
}

const near = (a, b, limit) => a.forEach((value, i) => assert.ok(Math.abs(value - b[i]) <= limit, `${a} is not ${b}`));

test('a frame is what the server encoded', () => {
    const frame = decodeFrame(golden(), 0.25);
    assert.equal(frame.number, 7);
    assert.equal(frame.t, 1500);
    assert.equal(Math.round(frame.sourceTime), 1700000000123);
    assert.deepEqual([...frame.players.keys()], [0, 1]);
    const player = frame.players.get(1);
    assert.equal(player.flags, 1);
    assert.deepEqual(player.position, [12.5, -3.25, 1024]);
    near(player.rotation, [0, 0, Math.sin(0.25), Math.cos(0.25)], 1e-3);
    const camera = frame.cameras.get(4000000000);
    assert.equal(camera.target, 1);
    assert.equal(camera.flags, cameraFlag.cut | cameraFlag.visible);
    assert.deepEqual(camera.position, [-100, 0, 50]);
    near(camera.rotation, [0, 0, Math.sin(-0.625), Math.cos(-0.625)], 5e-5);
    near([camera.fov], [1], 5e-5);
    assert.deepEqual([...frame.movers.keys()], [3, 4294967295]);
    const door = frame.movers.get(4294967295);
    assert.deepEqual(door.position, [8, -0.5, 96.25]);
    near(door.rotation, [0, 0, Math.sin(0.375), Math.cos(0.375)], 5e-5);
});

test('what is no frame is not read', () => {
    const whole = new Uint8Array(golden());
    for (let size = 0; size < whole.length; ++size)
        assert.equal(decodeFrame(whole.slice(0, size).buffer, 1), null);
    const other = whole.slice();
    other[0] = 9;
    assert.equal(decodeFrame(other.buffer, 1), null);
});

test('frames of any bytes are read or refused', () => {
    let seed = 1;
    let read = 0;
    for (let i = 0; i < 2000; ++i) {
        const bytes = new Uint8Array(i % 300);
        for (let at = 0; at < bytes.length; ++at) bytes[at] = (seed = seed * 48271 % 2147483647) & 255;
        bytes.set([1, 0, i % 4, 0, (i >> 2) % 4, 0, (i >> 4) % 4, 0].slice(0, bytes.length));  // counts that may fit
        const frame = decodeFrame(bytes.buffer, 1);
        if (!frame) continue;
        ++read;
        for (const all of [frame.players, frame.cameras, frame.movers])
            for (const {position, rotation} of all.values()) assert.ok([...position, ...rotation].every(Number.isFinite));
    }
    assert.ok(read > 1000 && read < 2000, `${read} were read`);
});
