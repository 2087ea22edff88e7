// The messages of idl/live.md.

export const version = 1;
export const subprotocol = `camera-director.v${version}`;

// The events that the page shows.
export const shownEvents = new Set(['kill', 'flag taken', 'flag captured', 'objective', 'award', 'round']);

export const playerFlag = {alive: 1, discontinuity: 2, spectator: 4};
export const cameraFlag = {cut: 1, visible: 2, searching: 4, absent: 8, held: 16};

const noSlot = 255;
const kindFrame = 1;
const headerSize = 28;
const playerSize = 14;
const cameraSize = 22;
const moverSize = 18;

// Signed, of 21 bits.
function signed21(value) {
    return (value << 11) >> 11;
}

function position(view, at, step) {
    const low = view.getUint32(at, true);
    const high = view.getUint32(at + 4, true);
    return [
        signed21(low & 0x1fffff) * step,
        signed21((low >>> 21) | ((high & 0x3ff) << 11)) * step,
        signed21((high >>> 10) & 0x1fffff) * step,
    ];
}

// The quaternion x y z w whose component `largest` was left out.
function rotation(parts, largest, top) {
    const q = [0, 0, 0, 0];
    let rest = 1;
    let next = 0;
    for (let i = 0; i < 4; ++i) {
        if (i === largest) continue;
        q[i] = (parts[next++] / top - 0.5) * Math.SQRT2;
        rest -= q[i] * q[i];
    }
    q[largest] = Math.sqrt(Math.max(rest, 0));
    return q;
}

function playerRotation(view, at) {
    const packed = view.getUint32(at, true);
    return rotation([packed & 0x3ff, (packed >>> 10) & 0x3ff, (packed >>> 20) & 0x3ff], packed >>> 30, 0x3ff);
}

// Of cameras and movers.
function fineRotation(view, at) {
    const low = view.getUint32(at, true);
    const high = view.getUint16(at + 4, true);
    const parts = [low & 0x7fff, (low >>> 15) & 0x7fff, (low >>> 30) | ((high & 0x1fff) << 2)];
    return rotation(parts, (high >>> 13) & 3, 0x7fff);
}

function slotOrNull(slot) {
    return slot === noSlot ? null : slot;
}

// `step`: position_step of the match. Null: it is no frame, or damaged.
export function decodeFrame(buffer, step) {
    if (buffer.byteLength < headerSize) return null;
    const view = new DataView(buffer);
    const playerCount = view.getUint16(2, true);
    const cameraCount = view.getUint16(4, true);
    const moverCount = view.getUint16(6, true);
    const size = headerSize + playerCount * playerSize + cameraCount * cameraSize + moverCount * moverSize;
    if (view.getUint8(0) !== kindFrame || buffer.byteLength < size) return null;
    const frame = {
        number: view.getUint32(8, true),
        t: Number(view.getBigInt64(12, true)) / 1e6,
        sourceTime: Number(view.getBigInt64(20, true) / 1000n) / 1e3,
        players: new Map(),
        cameras: new Map(),
        movers: new Map(),
    };
    let at = headerSize;
    for (let i = 0; i < playerCount; ++i, at += playerSize) {
        frame.players.set(view.getUint8(at), {
            slot: view.getUint8(at),
            flags: view.getUint8(at + 1),
            position: position(view, at + 2, step),
            rotation: playerRotation(view, at + 10),
        });
    }
    for (let i = 0; i < cameraCount; ++i, at += cameraSize) {
        const id = view.getUint32(at, true);
        frame.cameras.set(id, {
            id,
            target: slotOrNull(view.getUint8(at + 4)),
            flags: view.getUint8(at + 5),
            fov: view.getUint16(at + 6, true) / 65535 * Math.PI,
            position: position(view, at + 8, step),
            rotation: fineRotation(view, at + 16),
        });
    }
    for (let i = 0; i < moverCount; ++i, at += moverSize)
        frame.movers.set(view.getUint32(at, true), {position: position(view, at + 4, step), rotation: fineRotation(view, at + 12)});
    return frame;
}
