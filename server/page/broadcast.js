// Fetches the resources of a broadcast (idl/recording.md), from a director or a cache.
import {Damaged} from './bytes.js';
import {decodeResource, decodeStart, decodeSync, maxResource} from './recording.js';

const maxSync = 4096;  // bytes

// The server answers otherwise than with the resource.
export class Refused extends Error {
    constructor(name, status) {
        super(`${name}: the server answers with ${status}`);
        this.status = status;
    }
}

// All of an answer's body: at most `limit` bytes, whatever its header says.
async function bytesOf(answer, name, limit) {
    const reader = answer.body.getReader();
    const pieces = [];
    let size = 0;
    for (;;) {
        const {done, value} = await reader.read();
        if (done) break;
        pieces.push(value);
        size += value.length;
        if (size <= limit) continue;
        reader.cancel().catch(() => {});
        throw new Damaged(`${name}: more than ${limit} bytes`);
    }
    const bytes = new Uint8Array(size);
    pieces.reduce((at, piece) => (bytes.set(piece, at), at + piece.length), 0);
    return bytes;
}

export class Broadcast {
    // `ask(url, abort)`: as fetch.
    constructor(syncUrl, ask) {
        this.syncUrl = syncUrl;
        this.ask = ask;
        this.bytes = 0;  // that were fetched
    }

    // As decodeSync, with what a cache has added to the age.
    async sync(abort) {
        const {bytes, cachedS} = await this.get('sync', this.syncUrl, maxSync, abort);
        const sync = decodeSync(new TextDecoder().decode(bytes), 'sync');
        this.below = new URL(`${encodeURIComponent(sync.recording)}/`, this.syncUrl).href;
        return {...sync, ageMs: sync.ageMs + cachedS * 1000};
    }

    async start(abort) {
        const {bytes} = await this.get('start', `${this.below}start`, maxResource, abort);
        return decodeStart((await decodeResource(bytes, 'start', 0, 'start')).content, 'start');
    }

    // `file`: full or delta.
    async fragment(n, file, abort) {
        return (await this.get(`fragment ${n}, ${file}`, `${this.below}${n}/${file}`, maxResource, abort)).bytes;
    }

    async get(name, url, limit, abort) {
        const answer = await this.ask(url, abort);
        if (!answer.ok) throw new Refused(name, answer.status);
        const bytes = await bytesOf(answer, name, limit);
        this.bytes += bytes.length;
        return {bytes, cachedS: Math.max(Number(answer.headers.get('Age')) || 0, 0)};
    }
}
