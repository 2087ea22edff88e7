// Feeds the model from a match's stream (idl/live.md).
import {Connection} from './connection.js';
import {areMovers} from './contents.js';
import {latencyOf} from './latency.js';
import {decodeFrame, version} from './protocol.js';

// What the model keeps of it.
export const kept = {
    framesMs: 5 * 60e3,
    timing: {windowMs: 4e3, maxJitterMs: 400, farMs: 600},
    timeline: {keptMs: 5 * 60e3, maxStates: 4096, maxMarks: 1024},
};

const now = () => performance.now();

export class LiveSource {
    // `on.begin()`: what was shown is of another epoch or of other players; `on.match(note)`, `on.problem(text)`, `on.change()`.
    constructor(matchId, model, token, on) {
        Object.assign(this, {matchId, model, on});
        this.dropped = 0;
        this.age = null;  // ms from the sampling of the last frame to its arrival, null where it is not known
        this.repeats = false;  // the next frame may be an old one
        this.ended = false;
        this.isOutdated = false;  // the page: the server speaks another version
        this.step = 1;
        this.movers = [];      // as the last note has them
        model.begin(kept);
        this.link = new Connection(token, {
            state: (state, retryMs) => {
                this.connection = state;
                this.retryAt = retryMs === undefined ? null : now() + retryMs;
                on.change();
            },
            note: note => {
                this.notes[note.kind]?.(note);
                on.change();
            },
            frame: data => this.add(data),
        });
        this.link.watch(matchId);
    }

    close() {
        this.link.close();
    }

    // How often in a row the server has not opened the stream.
    get refusals() { return this.link.refusals; }

    // The server does not answer otherwise either.
    unreachable() {
        this.link.unreachable();
    }

    // The server says that the match runs.
    runs() {
        this.link.runs();
    }

    notes = {
        match: note => {
            if (note.version !== version) return this.stopAsOutdated();
            const before = this.model.note;
            if (before && (before.epoch !== note.epoch || before.map !== note.map || this.ended || this.isOfAnother(note))) {
                this.model.begin(kept);
                this.movers = [];
                this.on.begin();
            }
            this.ended = false;
            this.step = note.position_step;
            this.model.setMatch(note);
            this.on.match(note);
        },
        history: note => {
            this.movers = [];
            this.model.timeline.clear();
            this.model.timeline.addHistory(note);
            this.repeats = true;
        },
        movers: ({movers}) => {
            if (areMovers(movers)) this.movers = movers; else this.on.problem('What moves in the map cannot be read');
        },
        cut: note => this.model.timeline.addNote(note),
        event: note => this.model.timeline.addNote(note),
        dropped: ({frames}) => {
            this.dropped += frames;
            this.on.problem(`${frames} frames skipped: this connection is slow`);
        },
        // Of a server that stops the connection is tried again.
        end: ({reason}) => {
            this.ended = reason !== 'server';
            this.on.problem(this.ended ? 'The match has ended' : 'The server stops');
            if (this.ended) this.link.close();
        },
    };

    stopAsOutdated() {
        this.isOutdated = true;
        this.link.close();
        this.on.problem('The server speaks another version: reload this page');
    }

    // A server that was started again has given slots anew: what is kept would be read as of others. One that runs names all
    // that it has ever given.
    isOfAnother(note) {
        const ids = new Map(note.players.map(({slot, id}) => [slot, id]));
        return [...this.model.players].some(([slot, {id}]) => ids.get(slot) !== id);
    }

    add(data) {
        const {step, movers} = this;
        const frame = decodeFrame(data, step);
        if (!frame || !this.model.buffer.add(frame.t, data.byteLength, () => ({...decodeFrame(data, step), moverList: movers}))) return;
        this.model.clock.arrived(frame.t, now());
        this.model.timeline.addFrame(frame);
        this.age = latencyOf(frame.sourceTime, Date.now());
        if (this.age !== null && !this.repeats) this.model.timeline.addLatency(frame.t, this.age);
        this.repeats = false;
    }

    get range() {
        const {first, last} = this.model.buffer;
        return last === null ? null : [first, last];
    }

    seek(t) {
        const {buffer, clock} = this.model;
        clock.seek(Math.min(Math.max(t, buffer.first ?? t), buffer.last ?? t));
    }

    goLive() {
        this.model.clock.goLive();
    }

    advance(at) {
        const {buffer, clock} = this.model;
        clock.advance(at, buffer.first, buffer.last);
    }

    // What it does: outdated, connecting, waiting (until retryAt), silent, empty, ended, paused, live, behind.
    get state() {
        const {buffer, clock} = this.model;
        if (this.isOutdated) return 'outdated';
        if (this.ended) return 'ended';
        if (this.connection === 'waiting' || this.connection === 'connecting') return this.connection;
        if (this.connection === 'silent') return 'silent';
        if (buffer.last === null) return 'empty';
        if (clock.paused) return 'paused';
        return clock.live ? 'live' : 'behind';
    }
}
