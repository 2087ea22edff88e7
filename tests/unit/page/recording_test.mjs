import assert from 'node:assert/strict';
import {test} from 'node:test';
import {ByteSource, Damaged} from '../../../server/page/bytes.js';
import {Roster, apply, cutsOf, noState} from '../../../server/page/fragment.js';
import {cameraFlag} from '../../../server/page/protocol.js';
import {decodeRecords, decodeResource, decodeStart, decodeSync} from '../../../server/page/recording.js';
import * as writer from './recording_writer.mjs';

const files = writer.recording(2);
const delta = files['1/delta'];
const decode = (bytes, kind = 'delta', n = 1) => decodeResource(bytes, kind, n, 'r');
const fails = (bytes, message, ...more) => assert.rejects(decode(bytes, ...more), error => error instanceof Damaged && message.test(error.message));

function changed(at, value) {
    const bytes = delta.slice();
    bytes[at] = value;
    return bytes;
}

test('a resource is whole, of its name, and bounded', async () => {
    assert.equal((await decode(delta)).beginTime, writer.begin + 1000000000n);
    assert.equal((await decode(files.start, 'start', 0)).beginTime, 0n);
    for (const size of [0, 31]) await fails(delta.slice(0, size), /expected a header of 32 bytes/);
    await fails(delta.slice(0, -1), /byte 24: .* bytes follow the header, expected/);
    await fails(changed(0, 0), /byte 0: expected the magic/);
    await fails(changed(4, 2), /format version 2, expected 1/);
    await fails(delta, /kind 3 of fragment 1, expected full of 1/, 'full');
    await fails(delta, /kind 3 of fragment 1, expected delta of 2/, 'delta', 2);
    for (const at of [7, 9, 15, 28, 40, delta.length - 1])
        await fails(changed(at, delta[at] ^ 1), at === 9 ? /expected delta of 1/ : /byte 28: the checksum differs/);
    const size = content => writer.resource(3, 1, 0, [0], {size: content});
    await fails(size(64 << 21), /byte 20: content of .* expected at most/);
    await fails(size(2), /byte 32: expected 2 deflated bytes/);
    await fails(size(0), /byte 32: expected 0 deflated bytes/);
    assert.equal((await decode(changed(5, 9)).catch(error => error.message)).includes('checksum'), true);
});

test('numbers have up to 64 bits', () => {
    const read = (bytes, kind) => new ByteSource(Uint8Array.from(bytes), 'n')[kind]();
    for (const value of [0n, 1n, 127n, 128n, 2n ** 49n - 1n, 2n ** 49n, 2n ** 63n, 2n ** 64n - 1n])
        assert.equal(read(writer.varint(value), 'big'), value);
    for (const value of [0n, -1n, 1n, -(2n ** 63n), 2n ** 63n - 1n, 1700000000000000001n])
        assert.equal(read(writer.signed(value), 'bigDifference'), value);
    for (const value of [0, -1, 2147483647, -2147483648]) assert.equal(read(writer.signed(value), 'difference'), value);
    assert.equal(read(writer.varint(Number.MAX_SAFE_INTEGER), 'number'), Number.MAX_SAFE_INTEGER);
    assert.throws(() => read(writer.varint(2n ** 53n), 'number'), Damaged);
    assert.throws(() => read(writer.varint(2n ** 32n), 'id'), Damaged);
    assert.throws(() => read([...writer.varint(2n ** 63n).slice(0, 9), 2], 'big'), Damaged);
    assert.throws(() => read(Array(20).fill(0x80), 'big'), Damaged);
    assert.throws(() => read(Array(20).fill(0x80), 'number'), Damaged);
    assert.throws(() => read([0x80], 'big'), Damaged);
});

const records = content => decodeRecords(Uint8Array.from(content), 'r');

test('unknown kinds and what a newer version appends are skipped', () => {
    assert.deepEqual(records(writer.record(99, 0, [1, 2, 3])), []);
    assert.deepEqual(records(writer.record(4, 5, [0])), [], 'requests are not shown');
    const [first, second] = records([...writer.record(2, 2000000, [...writer.poses(7, 5, 1.5), 1, 2, 3]), ...writer.record(1, 500000, writer.match())]);
    assert.deepEqual(first.poses.players, [{id: 0, flags: 1, position: [1.5, 0, 0], rotation: [0, 0, 0, 1]}]);
    assert.equal(first.after, 2);
    assert.equal(second.after, 2.5);
    assert.equal(second.match.matchId, 'm');
});

test('records that are not what they should be are told by name and byte', () => {
    const whole = writer.record(2, 0, writer.poses(7, 5, 1.5));
    for (let size = 1; size < whole.length; ++size)
        assert.throws(() => records(whole.slice(0, size)), error => error instanceof Damaged && /^r: .*byte \d+: expected/.test(error.message));
    const wrong = (kind, body, message, step = 0) => assert.throws(() => records(writer.record(kind, step, body)), message);
    wrong(2, writer.poses(7, 5, Infinity), /finite/);
    wrong(2, writer.poses(7, 5, NaN), /finite/);
    wrong(1, writer.match(), /a time not before/, -1);
    wrong(2, [...writer.varint(1), 1, 0, 0, ...writer.varint(513)], /a list of at most/);
    wrong(2, [...writer.varint(1), 1, 0, 0, ...writer.varint(2n ** 40n)], /a list of at most/);
    const many = Array.from({length: (1 << 17) + 1}, () => writer.record(3, 0, [1, 0, 0, 0, 0, 0, 0, 0, 0, 0])).flat();
    assert.throws(() => records(many), /at most 131072 records/);
});

test('any bytes are read or refused', async () => {
    let seed = 3;
    const random = () => (seed = seed * 48271 % 2147483647);
    const valid = [...writer.record(1, 0, writer.match()), ...writer.record(2, 0, writer.poses(7, 5, 1.5)), ...writer.record(6, 0, writer.cameras(7, 5, 1))];
    for (let i = 0; i < 5000; ++i) {
        const bytes = valid.slice();
        for (let change = 0; change < 3; ++change) bytes[random() % bytes.length] = random() & 255;
        try {
            records(bytes);
        } catch (error) {
            assert.ok(error instanceof Damaged, error.stack);
        }
    }
});

test('a mover is where it was last placed, also before the list had it', () => {
    const list = (...ids) => ({moverList: {movers: ids.map(id => ({id}))}});
    const poses = (...places) => ({moverPoses: {movers: places.map(([id, x]) => ({id, position: [x, 0, 0], rotation: [0, 0, 0, 1]}))}});
    const placed = (...records) => [...records.reduce(apply, noState).movers].map(([id, {position}]) => [id, position[0]]);
    assert.deepEqual(placed(list(1), poses([1, 10], [2, 20]), list(1, 2)), [[1, 10], [2, 20]]);
    assert.deepEqual(placed(list(1, 2), poses([1, 10], [2, 20]), poses([2, 21])), [[1, 10], [2, 21]], 'left out: it stands');
    assert.deepEqual(placed(list(1, 2), poses([1, 10], [2, 20]), list(2)), [[2, 20]]);
    assert.deepEqual(placed(list(1), poses([1, 10]), list()), []);
});

test('of players the name that they had last is known, in whatever order matches are read', () => {
    const matchOf = (...players) => ({epoch: 1, players: players.map(([id, name]) => ({id, name, class: 'scout', team: 1}))});
    const roster = new Roster();
    const note = roster.note(matchOf([7, 'Ann'], [9, 'Bob']), 5000);
    assert.deepEqual(note.players.map(({slot, name}) => [slot, name]), [[0, 'Ann'], [1, 'Bob']]);
    roster.note(matchOf([9, 'Bobby'], [4, 'Carl']), 1000);
    const later = roster.note(matchOf([7, 'Anna']), 9000);
    roster.add([12]);
    assert.deepEqual(later.players[1], {slot: 1, id: 9, listed: false}, 'the note has what was then');
    assert.deepEqual([...roster.known].map(([slot, {id, name}]) => [slot, id, name]),
        [[0, 7, 'Anna'], [1, 9, 'Bob'], [2, 4, 'Carl'], [3, 12, undefined]]);
    assert.deepEqual(roster.known.get(1), {slot: 1, id: 9, listed: true, name: 'Bob', class: 'scout', team: 1});
});

test('start and sync are checked', async () => {
    const start = content => decodeStart(Uint8Array.from(content), 'start');
    assert.equal(start((await decode(files.start, 'start', 0)).content).match.players[1].name, 'Bob');
    assert.throws(() => start([...writer.text(''), ...writer.signed(0), ...writer.match()]), /a positive duration/);
    const sync = {version: 1, first_fragment: 2, last_fragment: 4, recording: 'r', fragment_duration_s: 3, age_s: 0.5, delay_s: 10, live: true};
    assert.deepEqual(decodeSync(JSON.stringify({...sync, more: 1}), 'sync'),
        {recording: 'r', first: 2, last: 4, durationMs: 3000, ageMs: 500, delayMs: 10000, live: true});
    for (const wrong of [{version: 2}, {first_fragment: 5}, {last_fragment: -1}, {last_fragment: 2 ** 32}, {last_fragment: '4'},
        {recording: undefined}, {fragment_duration_s: 0}])
        assert.throws(() => decodeSync(JSON.stringify({...sync, ...wrong}), 'sync'), Damaged, JSON.stringify(wrong));
    for (const text of ['', '{', 'null', '1', '[]', ' '.repeat(5000)]) assert.throws(() => decodeSync(text, 'sync'), Damaged, text);
});

test('a cut to a fixed camera says which moment it shows, also from another one', () => {
    const nobody = 0xffffffff;
    const frame = (target, flags = cameraFlag.cut) => ({cameras: [{id: 5, target, flags}],
        reasons: [{camera: 5, rule: 'duel', actor: 1, subject: 2}]});
    const cut = (before, now) => cutsOf(before, now, {players: []}, id => id === nobody ? null : id)[0];
    for (const before of [frame(1), frame(nobody)]) {
        const {reason, target, moment} = cut(before, frame(nobody));
        assert.deepEqual({reason, target, moment}, {reason: 'target', target: null, moment: {rule: 'duel', actor: 1, subject: 2}});
    }
    const absent = frame(nobody, cameraFlag.cut | cameraFlag.absent);
    assert.equal(cut(absent, absent).moment, undefined);
});
