// The resources of idl/recording.md, of which the page takes what it shows: matches, poses, events, cameras and movers.
// What is wrong with one is thrown as Damaged, which names it, the byte and what was expected.
import {ByteSource, Damaged, floatOf} from './bytes.js';

export const majorVersion = 1;
export const maxResource = (64 << 20) + 32;  // bytes, deflated

const kinds = {start: 1, full: 2, delta: 3};
const magic = 0x43524443;  // CDRC
const headerSize = 32;
const maxContent = 64 << 20;
const maxExpansion = 1032;
const maxRecords = 1 << 17;
const maxPlayers = 256;
const maxPoses = 512;
const maxCameras = 256;
const maxMovers = 256;
const maxHulls = 256;  // and balls, of a mover
const leastHalfSpaces = 4;
const maxHalfSpaces = 64;
const maxParts = 2048;   // half spaces of all movers, and balls
const maxLengthError = 1e-3;  // of quaternions

const crcTable = Uint32Array.from({length: 256}, (_, byte) => {
    for (let bit = 0; bit < 8; ++bit) byte = byte & 1 ? (byte >>> 1) ^ 0xedb88320 : byte >>> 1;
    return byte;
});

// zlib's, of several arrays one after the other.
function crc32(...parts) {
    let crc = 0xffffffff;
    for (const part of parts)
        for (let i = 0; i < part.length; ++i) crc = crcTable[(crc ^ part[i]) & 0xff] ^ (crc >>> 8);
    return (crc ^ 0xffffffff) >>> 0;
}

// Never takes more memory than `size` and a piece of the stream.
async function inflate(deflated, size, name) {
    const content = new Uint8Array(size);
    const wrong = () => new Damaged(`${name}: byte ${headerSize}: expected ${size} deflated bytes (zlib)`);
    const reader = new Blob([deflated]).stream().pipeThrough(new DecompressionStream('deflate')).getReader();
    let filled = 0;
    for (;;) {
        const {done, value} = await reader.read().catch(() => { throw wrong(); });
        if (done) break;
        if (filled + value.length > size) {
            reader.cancel().catch(() => {});
            throw wrong();
        }
        content.set(value, filled);
        filled += value.length;
    }
    if (filled !== size) throw wrong();
    return content;
}

// {beginTime: ns as BigInt, content: Uint8Array} of the resource `kind` (start, full, delta) of fragment n.
export async function decodeResource(bytes, kind, n, name) {
    const wrong = (at, what) => { throw new Damaged(`${name}: byte ${at}: ${what}`); };
    if (bytes.length < headerSize) wrong(bytes.length, `ends, expected a header of ${headerSize} bytes`);
    const header = new ByteSource(bytes, name);
    if (header.u32() !== magic) wrong(0, 'expected the magic CDRC of a recording');
    const version = header.u8();
    if (version !== majorVersion) wrong(4, `format version ${version}, expected ${majorVersion}: reload this page`);
    header.take(1);
    const found = {kind: header.u8(), n: (header.take(1), header.u32())};
    if (found.kind !== kinds[kind] || found.n !== n) wrong(6, `kind ${found.kind} of fragment ${found.n}, expected ${kind} of ${n}`);
    const beginTime = BigInt.asIntN(64, header.u64());
    const size = header.u32();
    const stored = header.u32();
    if (stored !== bytes.length - headerSize)
        wrong(24, `${bytes.length - headerSize} bytes follow the header, expected ${stored}`);
    if (size > Math.min(maxContent, stored * maxExpansion))
        wrong(20, `content of ${size} bytes, expected at most ${Math.min(maxContent, stored * maxExpansion)}`);
    const deflated = bytes.subarray(headerSize);
    if (header.u32() !== crc32(bytes.subarray(0, headerSize - 4), deflated)) wrong(28, 'the checksum differs: it is damaged');
    return {beginTime, content: await inflate(deflated, size, name)};
}

function readMatch(source) {
    return {
        matchId: source.text(), epoch: source.big(), map: source.text(), mapHash: source.u64(),
        metresPerUnit: source.float(), rateHz: source.float(), delayS: source.float(),
        players: Array.from({length: source.count(4, maxPlayers)},
            () => ({id: source.id(), name: source.text(), class: source.text(), team: source.u8()})),
    };
}

// {directorVersion, fragmentDuration in ns, match}.
export function decodeStart(content, name) {
    const source = new ByteSource(content, name);
    const directorVersion = source.text();
    const fragmentDuration = Number(source.bigDifference());
    if (!(fragmentDuration > 0)) source.fail('a positive duration of fragments');
    return {directorVersion, fragmentDuration, match: readMatch(source)};
}

// The floats of each player or camera, which are differences of bit patterns from those before in the resource.
class Floats {
    constructor(count) {
        this.count = count;
        this.before = new Map();
    }

    // count numbers, the four from 3 on a unit quaternion.
    read(source, id) {
        let bits = this.before.get(id);
        if (!bits) this.before.set(id, bits = new Int32Array(this.count));
        const values = [];
        for (let i = 0; i < this.count; ++i) {
            bits[i] += source.difference();
            const value = floatOf(bits[i]);
            if (!Number.isFinite(value)) source.fail('finite numbers');
            values.push(value);
        }
        if (!(Math.abs(Math.hypot(values[3], values[4], values[5], values[6]) - 1) <= maxLengthError))
            source.fail('unit quaternions');
        return values;
    }
}

// A list of half spaces or balls.
function readFours(source, least, most) {
    const list = Array.from({length: source.count(16, most)}, () => Array.from({length: 4}, () => source.float()));
    if (list.length < least) source.fail(`at least ${least} half spaces`);
    if (!list.flat().every(Number.isFinite)) source.fail('finite numbers');
    return list;
}

function readMovers(source) {
    const movers = Array.from({length: source.count(5, maxMovers)}, () => ({
        id: source.id(), name: source.text(), kind: source.text(),
        hulls: Array.from({length: source.count(1, maxHulls)}, () => readFours(source, leastHalfSpaces, maxHalfSpaces)),
        balls: readFours(source, 0, maxHulls),
    }));
    for (const parts of [movers.flatMap(({hulls}) => hulls.flat()), movers.flatMap(({balls}) => balls)])
        if (parts.length > maxParts) source.fail(`at most ${maxParts} half spaces and balls`);
    return movers;
}

function readFrameHead(source) {
    return {epoch: source.big(), number: source.id()};
}

const readers = {
    1: source => ({match: readMatch(source)}),
    2(source, {poses}) {
        const head = readFrameHead(source);
        const times = {frameTime: source.bigDifference(), sourceTime: source.bigDifference()};
        return {poses: {...head, ...times, players: Array.from({length: source.count(13, maxPoses)}, () => {
            const id = source.id();
            const flags = source.id();
            if (source.u8() !== 0) source.id();  // the counter of discontinuities, which are flags already
            const values = poses.read(source, id);
            return {id, flags, position: values.slice(0, 3), rotation: values.slice(3, 7)};
        })}};
    },
    3: source => ({event: {epoch: source.big(), frameTime: source.bigDifference(), event: source.id(), actor: source.id(),
        subject: source.id(), value: source.float(), detail: source.text()}}),
    6(source, {cameras}) {
        const head = readFrameHead(source);
        source.id();  // the number of the poses, which precede it
        const times = {frameTime: source.bigDifference(), sourceTime: source.bigDifference()};
        const shown = Array.from({length: source.count(12, maxCameras)}, () => {
            const id = source.id();
            const target = source.id();
            const flags = source.id();
            const values = cameras.read(source, id);
            return {id, target, flags, position: values.slice(0, 3), rotation: values.slice(3, 7), fov: values[7]};
        });
        const reasons = source.left === 0 ? [] : Array.from({length: source.count(4, maxCameras)},
            () => ({camera: source.id(), actor: source.id(), subject: source.id(), rule: source.text()}));
        return {cameras: {...head, ...times, cameras: shown, reasons}};
    },
    7: source => ({moverList: {epoch: source.big(), movers: readMovers(source)}}),
    8(source, {movers}) {
        const epoch = source.big();
        source.bigDifference();  // frame_time and
        source.bigDifference();  // source_time
        return {moverPoses: {epoch, movers: Array.from({length: source.count(8, maxMovers)}, () => {
            const id = source.id();
            const values = movers.read(source, id);
            return {id, position: values.slice(0, 3), rotation: values.slice(3, 7)};
        })}};
    },
};

// The records of `full` or `delta`: {after: ms since the fragment's begin, and one of match, poses, event, cameras,
// moverList, moverPoses}.
// Others are left out.
export function decodeRecords(content, name) {
    const source = new ByteSource(content, name);
    const floats = {poses: new Floats(10), cameras: new Floats(9), movers: new Floats(7)};
    const records = [];
    let after = 0n;
    while (source.left > 0) {
        const kind = source.number();
        const at = source.at;
        const record = new ByteSource(source.take(source.number()), `${name}: record of kind ${kind} at byte ${at}`);
        const step = record.bigDifference();
        if (step < 0n) record.fail('a time not before the last one');
        after += step;
        if (!readers[kind]) continue;
        if (records.length === maxRecords) source.fail(`at most ${maxRecords} records`);
        records.push({after: Number(after / 1000n) / 1000, ...readers[kind](record, floats)});
    }
    return records;
}

// `sync`, checked. Throws Damaged.
export function decodeSync(text, name) {
    let sync;
    try {
        sync = JSON.parse(text.slice(0, 4096));
    } catch {
        throw new Damaged(`${name}: expected JSON`);
    }
    const {version, first_fragment: first, last_fragment: last, recording, fragment_duration_s: durationS} = sync ?? {};
    if (version !== majorVersion) throw new Damaged(`${name}: version ${version}, expected ${majorVersion}: reload this page`);
    const isNumber = value => Number.isInteger(value) && value >= 0 && value <= 0xffffffff;
    if (!isNumber(first) || !isNumber(last) || first > last || typeof recording !== 'string' || !(durationS > 0))
        throw new Damaged(`${name}: expected recording, first_fragment, last_fragment and fragment_duration_s`);
    return {recording, first, last, durationMs: durationS * 1000, ageMs: Math.max(Number(sync.age_s) || 0, 0) * 1000,
        delayMs: Math.max(Number(sync.delay_s) || 0, 0) * 1000, live: sync.live === true};
}
