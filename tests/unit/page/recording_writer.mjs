// Small recordings in memory, of idl/recording.md: for tests of the page. The C++ writer's are read in recording_check.mjs.
import {deflateSync} from 'node:zlib';

export function varint(value) {
    const bytes = [];
    for (let left = BigInt(value); ; left >>= 7n) {
        bytes.push(Number(left & 0x7fn) | (left > 0x7fn ? 0x80 : 0));
        if (left <= 0x7fn) return bytes;
    }
}

export const signed = value => varint(BigInt.asUintN(64, (BigInt(value) << 1n) ^ (BigInt(value) >> 63n)));
export const text = value => [...varint(new TextEncoder().encode(value).length), ...new TextEncoder().encode(value)];

function fixed(value, size) {
    return Array.from({length: size}, (_, i) => Number((BigInt(value) >> BigInt(8 * i)) & 0xffn));
}

const bitsOf = value => new Int32Array(new Float32Array([value]).buffer)[0];
const float = value => fixed(BigInt.asUintN(32, BigInt(bitsOf(value))), 4);
// Of the first record in a resource: differences from 0.
const bits = values => values.flatMap(value => signed(bitsOf(value)));
const list = items => [...varint(items.length), ...items.flat()];

// The body follows the step of time in ns.
export const record = (kind, step, body) => {
    const content = [...signed(step), ...body];
    return [...varint(kind), ...varint(content.length), ...content];
};

export const match = ({id = 'm', epoch = 1, map = 'hall', players = [[0, 'Ann'], [1, 'Bob']]} = {}) =>
    [...text(id), ...varint(epoch), ...text(map), ...fixed(0, 8), ...float(0.0254), ...float(20), ...float(0),
        ...list(players.map(([player, name]) => [...varint(player), ...text(name), ...text(''), 1]))];

// One player at (x, 0, 0).
export const poses = (number, frameTime, x, player = 0, sourceTime = 0) => [...varint(1), ...varint(number), ...signed(frameTime), ...signed(sourceTime),
    ...list([[...varint(player), ...varint(1), 0, ...bits([x, 0, 0, 0, 0, 0, 1, 0, 0, 0])]])];

export const cameras = (number, frameTime, x, {flags = 2, target = 0} = {}) => [...varint(1), ...varint(number), ...varint(number),
    ...signed(frameTime), ...signed(0), ...list([[...varint(5), ...varint(target), ...varint(flags),
        ...bits([x, 0, 0, 0, 0, 0, 1, 1, 10])]]), 0];

function crc32(bytes) {
    let crc = -1;
    for (const byte of bytes) {
        crc ^= byte;
        for (let i = 0; i < 8; ++i) crc = (crc >>> 1) ^ (crc & 1 ? 0xedb88320 : 0);
    }
    return ~crc >>> 0;
}

export function resource(kind, n, beginTime, content, {size = content.length} = {}) {
    const deflated = [...deflateSync(Uint8Array.from(content))];
    const header = [...fixed(0x43524443, 4), 1, 1, kind, 0, ...fixed(n, 4), ...fixed(BigInt.asUintN(64, BigInt(beginTime)), 8),
        ...fixed(size, 4), ...fixed(deflated.length, 4)];
    return Uint8Array.from([...header, ...fixed(crc32([...header, ...deflated]), 4), ...deflated]);
}

export const begin = 1700000000000000000n;
export const durationMs = 1000;

// The resources by name of a match of `count` fragments of a second, each with one frame, in which player 0 is at its
// number, and a kill. `at(n)`: when a fragment begins, in ms. `latencyMs`: of its frame; without it there is no source time.
export function recording(count, at = n => n * durationMs, latencyMs = null) {
    const files = {start: resource(1, 0, 0, [...text('0'), ...signed(durationMs * 1e6), ...match()])};
    const sourceTime = n => latencyMs === null ? 0 : begin + BigInt(at(n) - latencyMs) * 1000000n;
    const frame = (n, more) => [...record(2, 0, poses(n, at(n) * 1e6, n, 0, sourceTime(n))), ...record(6, 0, cameras(n, at(n) * 1e6, n, more))];
    for (let n = 0; n < count; ++n) {
        const time = begin + BigInt(at(n)) * 1000000n;
        const full = n === 0 ? [] : [...record(1, 0, match()), ...frame(n - 1)];
        const kill = [...varint(1), ...signed(at(n) * 1e6), ...varint(1), ...varint(0), ...varint(1), ...float(0), ...text('axe')];
        const delta = [...(n === 0 ? record(1, 0, match()) : []), ...frame(n, {flags: 3}), ...record(3, 1e6, kill)];
        files[`${n}/full`] = resource(2, n, time, full);
        files[`${n}/delta`] = resource(3, n, time, delta);
    }
    return files;
}
