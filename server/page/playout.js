// Some minutes of a match, and the clock that plays them.
import {cameraFlag, playerFlag} from './protocol.js';

const defaultBytes = 64e6;  // of a buffer
// How far live playing stays behind the fastest arrivals: as much as the others were late, and a frame.
const frameMs = 40;
const maxGapMs = 300;      // frames farther apart are not interpolated
const maxDecoded = 16;

function mix(a, b, part) {
    return a.map((value, i) => value + (b[i] - value) * part);
}

function mixRotations(a, b, part) {
    const dot = a.reduce((sum, value, i) => sum + value * b[i], 0);
    const q = mix(a, dot < 0 ? b.map(value => -value) : b, part);
    const length = Math.hypot(...q);
    return q.map(value => value / length);
}

// `before` on its way to `after`.
function between(before, after, part) {
    return {...before, position: mix(before.position, after.position, part), rotation: mixRotations(before.rotation, after.rotation, part)};
}

// Frames in the order of their time, bounded.
export class FrameBuffer {
    constructor(keptMs, keptBytes = defaultBytes) {
        Object.assign(this, {keptMs, keptBytes});
        this.clear();
    }

    clear() {
        this.frames = [];
        this.bytes = 0;
        this.decoded = new Map();
    }

    // `bytes`: that it takes; `read()` returns the frame. What is seen from `neededFrom` on stays, however much it takes.
    // Returns whether it was kept: it is newer than the last.
    add(t, bytes, read, neededFrom = Infinity) {
        if (this.frames.length > 0 && t <= this.last) return false;
        this.frames.push({t, bytes, read});
        this.bytes += bytes;
        let old = 0;
        while (old < this.frames.length - 1 && this.frames[old + 1].t <= neededFrom &&
            (t - this.frames[old].t > this.keptMs || this.bytes > this.keptBytes)) this.bytes -= this.frames[old++].bytes;
        if (old > 0) this.frames.splice(0, old);
        return true;
    }

    // Whether there is room for more than what is kept after t.
    hasRoomAfter(t) {
        const bytes = this.frames.slice(this.indexAt(t) + 1).reduce((sum, frame) => sum + frame.bytes, 0);
        return bytes < this.keptBytes * 3 / 4;
    }

    get first() { return this.frames[0]?.t ?? null; }
    get last() { return this.frames[this.frames.length - 1]?.t ?? null; }

    // The index of the last frame at or before t; 0 where none is.
    indexAt(t) {
        let low = 0;
        let high = this.frames.length - 1;
        while (low < high) {
            const middle = (low + high + 1) >> 1;
            if (this.frames[middle].t <= t) low = middle; else high = middle - 1;
        }
        return low;
    }

    // When the next frame is, where it is more than `ms` after the one at t; else null.
    silenceAfter(t, ms) {
        const index = this.indexAt(t);
        const next = this.frames[index + 1];
        return next && t >= this.frames[index].t && next.t - this.frames[index].t > ms ? next.t : null;
    }

    decode(index) {
        const {t, read} = this.frames[index];
        let frame = this.decoded.get(t);
        if (!frame) {
            frame = read();
            this.decoded.set(t, frame);
            if (this.decoded.size > maxDecoded) this.decoded.delete(this.decoded.keys().next().value);
        }
        return frame;
    }

    // What is seen at t: between two frames, interpolated, but never over a cut, a jump or the begin of an epoch.
    // `cutBetween(camera, from, to)`: whether a cut is known of that no frame shows.
    sample(t, cutBetween = () => false) {
        if (this.frames.length === 0) return null;
        const index = this.indexAt(t);
        const a = this.decode(index);
        if (index + 1 >= this.frames.length || t <= a.t) return a;
        const b = this.decode(index + 1);
        if (b.t - a.t > maxGapMs || a.epoch !== b.epoch) return a;
        const part = (t - a.t) / (b.t - a.t);
        const players = new Map();
        for (const [slot, before] of a.players) {
            const after = b.players.get(slot);
            players.set(slot, !after || after.flags & playerFlag.discontinuity ? before : between(before, after, part));
        }
        const cameras = new Map();
        for (const [id, before] of a.cameras) {
            const after = b.cameras.get(id);
            const jumps = !after || after.flags & cameraFlag.cut || after.target !== before.target ||
                cutBetween(id, a.t, b.t);
            cameras.set(id, jumps ? before : {...between(before, after, part), fov: before.fov + (after.fov - before.fov) * part});
        }
        const movers = new Map();
        for (const [id, before] of a.movers) {
            const after = b.movers.get(id);
            movers.set(id, after ? between(before, after, part) : before);
        }
        return {...a, t, players, cameras, movers};
    }
}

// Which time of the match is shown. Live, it runs evenly whatever the jitter of arrivals, a little behind the
// newest frame; else it was moved by the viewer.
export class PlayoutClock {
    // `timing`: windowMs, of arrivals that count; maxJitterMs, by which they may be late; farMs: a clock that is farther
    // from where it should be jumps.
    constructor(timing) {
        this.timing = timing;
        this.reset();
    }

    reset() {
        this.t = null;
        this.live = true;
        this.paused = false;
        this.speed = 1;
        this.arrivals = [];
    }

    // A frame of time t has arrived `now` (ms of any clock that runs evenly).
    arrived(t, now) {
        this.arrivals.push({now, offset: now - t});
        while (this.arrivals[0].now < now - this.timing.windowMs) this.arrivals.shift();
    }

    // Stands still until `now`.
    hold(now) {
        this.now = now;
    }

    // Moves on to `now`, within what is kept, first to last; null: nothing. `follows`: whether last is the newest there
    // is, from which on playing is live.
    advance(now, first, last, follows = true) {
        const elapsed = this.now === undefined ? 0 : Math.min(now - this.now, 1000);
        this.now = now;
        if (first === null) return;
        if (this.t === null) this.t = last;
        if (!this.paused) this.t += elapsed * (this.live ? this.pace(now) : this.speed);
        if (this.live && this.arrivals.length > 0) {
            const target = this.target(now);
            if (Math.abs(target - this.t) > this.timing.farMs) this.t = target;
        }
        if (this.t >= last && follows && !this.live && !this.paused) {
            this.live = true;
            this.speed = 1;
        }
        this.t = Math.min(Math.max(this.t, first), last);
    }

    // Where live playing should be.
    target(now) {
        const offsets = this.arrivals.map(arrival => arrival.offset);
        const fastest = Math.min(...offsets);
        return now - fastest - Math.min(Math.max(...offsets) - fastest, this.timing.maxJitterMs) - frameMs;
    }

    pace(now) {
        if (this.arrivals.length === 0) return 1;
        return 1 + Math.min(Math.max((this.target(now) - this.t) / 1000, -0.1), 0.1);
    }

    seek(t) {
        this.t = t;
        this.live = false;
    }

    goLive() {
        this.live = true;
        this.paused = false;
        this.speed = 1;
        if (this.arrivals.length > 0 && this.now !== undefined) this.t = this.target(this.now);
    }

    setPaused(paused) {
        this.paused = paused;
        if (paused) this.live = false;
    }

    setSpeed(speed) {
        this.speed = speed;
        if (speed !== 1) this.live = false;
    }
}
