// Plays a recording, or a match that is broadcast: fetches the fragments that the clock comes to, seeks in all there is.
// One thing is fetched at a time, what is needed first.
import {Damaged} from './bytes.js';
import {Refused} from './broadcast.js';
import {Roster, readFragment, readState} from './fragment.js';
import {FragmentIndex, slackMs} from './fragment_index.js';

// What the model keeps of a recording.
export const kept = {
    framesMs: 60e3,
    timing: {windowMs: 30e3, maxJitterMs: 6e3, farMs: 4e3},
    timeline: {keptMs: Infinity, maxStates: 1 << 16, maxMarks: 1 << 16},
};

const aheadMs = 15e3;       // that is fetched before the clock comes to it
const keepMs = 4 * 60e3;    // between looks at an ended broadcast: the server drops it when nobody asks for ten minutes
const silenceMs = 2e3;      // frames farther apart: playing goes on with the next
const lookMs = 250;         // after a fragment is to be complete
const lateMs = 1500;        // how late one may be found, and fetched, without playing having to stand still
const syncRetryMs = 1e3;    // what a cache keeps `sync`
const maxBehind = 3;        // fragments that live playing catches up with; from farther back it jumps to the newest
const maxSurveyBytes = 128e6;  // that may be fetched for the timeline alone
const leastSurveyPauseMs = 10;
const surveyPauses = 3;     // times as long as the reading of a fragment took
const maxUnreadable = 16;   // fragments, one after the other
const firstRetryMs = 500;
const longestRetryMs = 15e3;
const frameBytes = 400;     // of a player, camera or mover in memory

const now = () => performance.now();
const isMissing = error => error instanceof Refused && (error.status === 404 || error.status === 410);

export class Playback {
    // `on.match(note)`: of the time that is shown; `on.problem(text)`; `on.token()`: the server wants another one.
    constructor(broadcast, model, on) {
        Object.assign(this, {broadcast, model, on});
        model.begin(kept);
        this.roster = new Roster();
        this.states = new Map();     // of the match at the begin of fragments
        this.surveyed = new Set();   // numbers of those that the timeline has
        this.surveyBytes = 0;        // that were fetched for it alone
        this.decodeMs = 0;           // of the fragment that was read last
        this.unreadable = new Map(); // why, by number
        this.notes = [];             // {t, note, key} of what is loaded
        this.loaded = null;          // {last: number, from, to: ms}
        this.retryMs = firstRetryMs;
        this.isGone = false;         // from the server
        this.problems = [];
    }

    // `begin`: {t} in ms, {behind} in ms before what is newest, or {} for the newest.
    open(begin) {
        this.abort = new AbortController();
        this.begin = begin;
        this.run();
    }

    close() {
        this.closed = true;
        this.abort.abort();
        this.wake();
    }

    async run() {
        while (!this.closed) {
            this.abort = new AbortController();
            try {
                await (this.nextJob() ?? (() => this.sleep(250)))();
                this.retryMs = firstRetryMs;
                this.retryAt = null;
            } catch (error) {
                if (!this.abort.signal.aborted) await this.pause(error);
            }
        }
    }

    // The network or the server does not answer: later again.
    async pause(error) {
        if (error instanceof Refused && error.status === 401) this.on.token();
        if (error instanceof Damaged || isMissing(error)) this.tell(error.message);
        const wait = this.retryMs * (0.75 + Math.random() / 2);
        this.retryMs = Math.min(this.retryMs * 2, longestRetryMs);
        this.retryAt = now() + wait;
        await this.sleep(wait);
    }

    sleep(ms) {
        return new Promise(resolve => {
            this.wake = resolve;
            setTimeout(resolve, ms);
        });
    }

    wake() {}

    tell(problem) {
        this.problems.push(problem);
        if (this.problems.length > 100) this.problems.shift();
        this.on.problem(problem);
    }

    nextJob() {
        const {clock} = this.model;
        if (!this.start) return () => this.prepare();
        if (!this.sync.live && now() >= this.keepDue) return () => this.keep();
        if (this.isGone) return null;
        if (this.seeksNewest) return () => this.loadNewest();
        if (!this.covers(clock.t)) return () => this.load(clock.t);
        if (this.loaded.last < this.sync.last && this.loaded.to - clock.t < aheadMs && this.model.buffer.hasRoomAfter(clock.t))
            return () => this.append(this.loaded.last + 1);
        if (this.sync.live && now() >= this.syncDue) return () => this.refresh();
        if (!clock.live && this.surveyBytes < maxSurveyBytes) {
            const n = this.nextToSurvey();
            if (n !== null) return () => this.survey(n);
        }
        return null;
    }

    async refresh() {
        const sync = await this.broadcast.sync(this.abort.signal);
        if (this.sync && sync.recording !== this.sync.recording) {
            this.tell('Another recording of this match has begun');
            this.close();
            return this.on.restart();
        }
        // One of several caches may know less than another.
        const isNew = !this.sync || sync.last > this.sync.last;
        if (isNew || sync.last === this.sync.last) {
            this.sync = sync;
            this.syncAt = now();
            if (this.index) this.noteNewest();
        }
        this.syncDue = now() + (isNew ? Math.max(sync.durationMs - sync.ageMs, 0) + lookMs : syncRetryMs);
    }

    // Of a viewer that pauses, or has fetched everything, nothing else is heard.
    async keep() {
        await this.refreshEnded();
        this.keepDue = now() + keepMs;
    }

    // What has ended is gone at last, with its `sync`: what is loaded is all that can be seen then, unless it comes back.
    async refreshEnded() {
        try {
            await this.refresh();
            this.isGone = false;
        } catch (error) {
            if (!isMissing(error)) throw error;
            if (!this.isGone) this.tell('The server no longer has this: only what is loaded can be seen');
            this.isGone = true;
        }
    }

    async prepare() {
        await this.refresh();
        const start = await this.broadcast.start(this.abort.signal);
        const first = await this.readable(this.sync.first, 1);
        this.origin = first.beginTime - BigInt(Math.round((first.n - this.sync.first) * this.sync.durationMs * 1e6));
        const beginOf = ({beginTime}) => Number(beginTime - this.origin) / 1e6;
        // Slots are in the order in which players come.
        const note = this.roster.note(first.state.match ?? start.match, beginOf(first));
        const last = await this.readable(this.sync.last, -1);
        this.index = new FragmentIndex(this.sync.durationMs);
        for (const fragment of [first, last]) this.index.add(fragment.n, beginOf(fragment));
        if (!this.sync.live) await this.read(last.n);  // tells where it ends
        this.noteNewest();
        this.keepDue = now() + keepMs;
        this.start = start;
        this.on.match(note);
        const {t, behind} = this.begin;
        if (t === undefined && behind === undefined) this.goLive(); else this.seek(t ?? this.newest() - behind);
    }

    // The state of the next fragment from n on, in steps, that can be read.
    async readable(n, step) {
        for (let i = 0; i < maxUnreadable && n >= this.sync.first && n <= this.sync.last; ++i, n += step) {
            try {
                return {n, ...await this.readState(n)};
            } catch (error) {
                this.leaveOut(n, error);
            }
        }
        throw new Damaged(`No fragment of this recording can be read: ${[...this.unreadable.values()].pop()}`);
    }

    // Tells why a fragment is not shown; other errors are thrown on.
    leaveOut(n, error) {
        if (!(error instanceof Damaged) && !isMissing(error)) throw error;
        if (this.unreadable.has(n)) return;
        this.unreadable.set(n, error.message);
        this.tell(`${isMissing(error) ? 'Missing' : 'Damaged'}, left out: ${error.message}`);
    }

    async readState(n) {
        const {signal} = this.abort;
        const found = await readState(await this.broadcast.fragment(n, 'full', signal), n);
        signal.throwIfAborted();
        this.keepState(n, found.state);
        return found;
    }

    // Null: it cannot be read.
    async read(n) {
        if (this.unreadable.has(n)) return null;
        try {
            const {signal} = this.abort;
            const state = this.states.get(n) ?? (await this.readState(n)).state;
            const bytes = await this.broadcast.fragment(n, 'delta', signal);
            const begin = now();
            const fragment = await readFragment(bytes, n, state, this.origin, this.roster);
            signal.throwIfAborted();
            this.index.add(n, fragment.from, fragment.to);
            this.keepState(n + 1, fragment.state);
            this.enter(fragment);
            this.tellPlayers();
            this.decodeMs = now() - begin;
            return fragment;
        } catch (error) {
            if (isMissing(error)) await this.leaveIfRemoved(n, error);
            this.leaveOut(n, error);
            return null;
        }
    }

    // A recording that has become too large loses its oldest fragments, one that has ended all at once, with `sync`.
    async leaveIfRemoved(n, error) {
        const {signal} = this.abort;
        if (this.isLive) await this.refresh(); else await this.refreshEnded();
        if (this.isGone) this.abort.abort();
        signal.throwIfAborted();  // or another recording has begun
        if (n >= this.sync.first) return;
        this.loaded = null;
        if (this.model.clock.live) {
            this.goLive();
        } else {
            this.tell('What was here is no longer kept: it goes on with the oldest that is');
            this.seek(-Infinity);
        }
        throw error;  // the job is aborted
    }

    keepState(n, state) {
        this.states.set(n, state);
        if (this.states.size > 4) this.states.delete(this.states.keys().next().value);
    }

    // Into the timeline, once.
    enter(fragment) {
        if (this.surveyed.has(fragment.n)) return;
        this.surveyed.add(fragment.n);
        const part = this.model.newTimeline();
        for (const frame of fragment.frames) {
            part.addFrame(frame);
            if (frame.latency !== null) part.addLatency(frame.t, frame.latency);
        }
        for (const note of [...fragment.cuts, ...fragment.events]) part.addNote(note);
        this.model.timeline.insert(part, fragment.to);
    }

    // Names of players at other times than the one that is shown, whose match is told again: its players may look otherwise.
    tellPlayers() {
        const known = [...this.roster.known.values()];
        const key = JSON.stringify(known);
        if (key === this.knownKey) return;
        this.knownKey = key;
        this.model.setKnown(known);
        this.shownKey = null;
    }

    // For the timeline alone; leaves time to draw.
    async survey(n) {
        const {bytes} = this.broadcast;
        await this.read(n);
        this.surveyBytes += this.broadcast.bytes - bytes;
        await this.sleep(Math.max(surveyPauses * this.decodeMs, leastSurveyPauseMs));
    }

    // Behind what is loaded first, then from the begin.
    nextToSurvey() {
        const {first, last} = this.sync;
        const isKnown = n => this.surveyed.has(n) || this.unreadable.has(n);
        for (let n = this.loaded.last; n <= last; ++n) if (!isKnown(n)) return n;
        for (let n = first; n < this.loaded.last; ++n) if (!isKnown(n)) return n;
        return null;
    }

    async load(t) {
        const {clock} = this.model;
        let fragment = null;
        for (let n = this.locate(t), reads = 0; n !== null && reads < maxUnreadable; ++reads) {
            fragment = await this.read(n);
            const next = fragment ? this.locate(t) : this.nextReadable(n);
            if (next === n) break;
            n = next;
        }
        if (!fragment) this.failHere();
        this.replace(fragment);
        // Where nothing was recorded, or nothing can be read, it goes on with what follows.
        if (clock.t === t) clock.t = Math.min(Math.max(t, fragment.from), fragment.to);
    }

    failHere() {
        throw new Damaged(`Nothing can be read here: ${[...this.unreadable.values()].pop()}`);
    }

    async newestReadable(last) {
        let fragment = null;
        for (let n = last; !fragment && n > last - maxUnreadable && n >= this.sync.first; --n) {
            n = (await this.readable(n, -1)).n;
            fragment = await this.read(n);
        }
        return fragment;
    }

    async loadNewest() {
        await this.refresh();
        const {last} = this.sync;
        const fragment = await this.newestReadable(last);
        if (!fragment) this.failHere();
        this.seeksNewest = false;
        this.replace(fragment);
        this.loaded.last = last;  // those between cannot be read
        const {clock} = this.model;
        clock.arrivals = [];
        clock.arrived(fragment.from, this.syncAt - this.sync.ageMs + lateMs);
        this.newestArrived = fragment.n;
        clock.t = Math.min(clock.target(now()), fragment.to);  // in the fragment before, where this one is new
    }

    replace(fragment) {
        this.model.buffer.clear();
        this.notes = [];
        this.loaded = {last: fragment.n, from: fragment.from, to: fragment.to};
        this.put(fragment);
    }

    async append(n) {
        const fragment = await this.read(n);
        this.loaded.last = n;
        if (!fragment) return;
        if (this.model.clock.live && n > this.newestArrived) {
            this.model.clock.arrived(fragment.from, now());
            this.newestArrived = n;
        }
        this.loaded.to = fragment.to;
        this.put(fragment);
    }

    put(fragment) {
        const {buffer, clock} = this.model;
        const neededFrom = Math.min(clock.t ?? Infinity, fragment.from);
        const first = buffer.first;
        let movers = null;  // that the frame before has as well
        for (const frame of fragment.frames) {
            const own = frame.movers === movers ? 0 : frame.movers.size;
            movers = frame.movers;
            buffer.add(frame.t, frameBytes * (1 + frame.players.size + frame.cameras.size + own), () => frame, neededFrom);
        }
        if (first !== null && buffer.first > first) this.loaded.from = buffer.first;
        for (const {t, note} of fragment.matches) this.notes.push({t, note, key: JSON.stringify(note)});
        while (this.notes.length > 1 && this.notes[1].t <= this.loaded.from) this.notes.shift();
    }

    locate(t) {
        return this.index.locate(t, this.sync.first, this.sync.last);
    }

    // After n, else before it; null: none.
    nextReadable(n) {
        for (let next = n + 1; next <= this.sync.last; ++next) if (!this.unreadable.has(next)) return next;
        for (let next = n - 1; next >= this.sync.first; --next) if (!this.unreadable.has(next)) return next;
        return null;
    }

    covers(t) {
        return this.loaded !== null && t >= this.loaded.from - slackMs && t <= this.loaded.to + slackMs;
    }

    // What observers see now, in ms of the model. A cache may have kept a `sync` whose age is no longer true: the one that
    // says most is the youngest.
    newest() {
        return this.aheadMs + now();
    }

    noteNewest() {
        this.aheadMs = Math.max(this.aheadMs ?? -Infinity, this.index.endOf(this.sync.last) + this.sync.ageMs - this.syncAt);
    }

    // [first, last] ms where one may go, or null.
    get range() {
        if (!this.start) return null;
        if (this.isGone && this.loaded !== null) return [this.loaded.from, this.loaded.to];
        return [this.index.beginOf(this.sync.first), this.index.endOf(this.sync.last)];
    }

    get isLive() { return this.sync?.live ?? false; }

    // Everything there is was played.
    get atEnd() {
        return this.loaded !== null && (this.isGone || this.loaded.last >= this.sync.last) && this.model.clock.t >= this.loaded.to - 1;
    }

    seek(t) {
        const [first, last] = this.range;
        const wasNewest = this.seeksNewest;  // which is being loaded
        this.seeksNewest = false;
        this.model.clock.seek(Math.min(Math.max(t, first), last));
        if (wasNewest || !this.covers(this.model.clock.t)) this.abort.abort();
        this.wake();
    }

    goLive() {
        this.model.clock.goLive();
        this.seeksNewest = true;
        this.abort.abort();
        this.wake();
    }

    // Moves the clock on.
    advance(at) {
        const {clock, buffer} = this.model;
        // Nothing was drawn for long, or the connection is slow.
        if (clock.live && this.loaded && this.sync.last - this.loaded.last > maxBehind) this.seeksNewest = true;
        if (clock.t === null || this.seeksNewest || !this.covers(clock.t)) return clock.hold(at);
        const follows = this.isLive && this.loaded.last >= this.sync.last;
        clock.advance(at, this.loaded.from, this.loaded.to, false);
        const next = clock.live || clock.paused ? null : buffer.silenceAfter(clock.t, silenceMs);
        if (next !== null) clock.t = next;
        if (this.atEnd && !clock.live && !clock.paused)
            if (follows) this.on.newest(); else if (!this.isLive) clock.setPaused(true);
        this.showMatch(clock.t);
    }

    showMatch(t) {
        let shown = this.notes[0];
        for (const entry of this.notes) if (entry.t <= t) shown = entry;
        if (!shown || shown.key === this.shownKey) return;
        this.shownKey = shown.key;
        this.on.match(shown.note);
    }

    // What it does: opening, waiting (until retryAt), loading, paused, ended, live, playing.
    get state() {
        const {clock} = this.model;
        if (this.retryAt) return 'waiting';
        if (!this.start) return 'opening';
        if (this.isGone && !this.covers(clock.t)) return 'ended';
        if (this.seeksNewest || !this.covers(clock.t)) return 'loading';
        if (!this.isLive && this.atEnd) return 'ended';
        if (clock.paused) return 'paused';
        if (clock.live) return 'live';
        return this.loaded.last < this.sync.last && clock.t >= this.loaded.to - 1 ? 'loading' : 'playing';
    }
}
