// What happened in a match, as far as it is known: how each shot went, cuts with their reasons, events.
import {stepMs} from './latency.js';
import {cameraFlag, shownEvents} from './protocol.js';

const maxGapMs = 300;  // between parts that follow each other, or by which they overlap

// The index of the first entry that is later than t.
function indexAfter(entries, t) {
    let low = 0;
    let high = entries.length;
    while (low < high) {
        const middle = (low + high) >> 1;
        if (entries[middle].t <= t) low = middle + 1; else high = middle;
    }
    return low;
}

const byTime = (a, b) => a.t - b.t;
const isSame = (a, b) => a.flags === b.flags && a.target === b.target;

export class Timeline {
    // `keptMs`: before the newest frame; of a shot at most maxStates, and maxMarks cuts and as many events.
    constructor({keptMs, maxStates, maxMarks}) {
        Object.assign(this, {keptMs, maxStates, maxMarks});
        this.latencies = [];  // [{t, ms}], of each stepMs the greatest
        this.clear();
    }

    // What a history tells again.
    clear() {
        this.shots = new Map();  // by camera: [{t, target, flags}], flags null: the shot has ended, or is not known
        this.cuts = [];
        this.events = [];
    }

    addState(t, camera, target, flags) {
        if (!this.shots.has(camera)) this.shots.set(camera, []);
        const states = this.shots.get(camera);
        const last = states[states.length - 1];
        const state = {t, target, flags: flags === null ? null : flags & ~cameraFlag.cut};
        if (last && (t <= last.t || isSame(last, state))) return;
        states.push(state);
        if (states.length > this.maxStates) states.shift();
    }

    // The shots of a frame.
    addFrame(frame) {
        for (const [id, camera] of frame.cameras) this.addState(frame.t, id, camera.target, camera.flags);
        for (const [id, states] of this.shots) {
            const last = states[states.length - 1];
            if (!frame.cameras.has(id) && last.flags !== null) this.addState(frame.t, id, last.target, null);
        }
        this.forget(frame.t - this.keptMs);
    }

    // Of a frame at t (latency.js). Times ascend.
    addLatency(t, ms) {
        const last = this.latencies[this.latencies.length - 1];
        if (last && t < last.t + stepMs) last.ms = Math.max(last.ms, ms);
        else this.latencies.push({t, ms});
    }

    // Null where none is known.
    latencyAt(t) {
        const known = this.latencies[indexAfter(this.latencies, t) - 1];
        return known && t < known.t + stepMs ? known.ms : null;
    }

    // A cut, or an event, which is kept where the page shows such.
    addNote(note) {
        if (note.kind !== 'cut' && !shownEvents.has(note.event)) return;
        const marks = note.kind === 'cut' ? this.cuts : this.events;
        marks.push(note);
        if (marks.length > this.maxMarks) marks.shift();
    }

    addHistory(history) {
        for (const [t, camera, target, flags] of history.states) this.addState(t, camera, target, flags);
        for (const note of history.notes) this.addNote(note);
    }

    // Another timeline, of a part of the match that ends at `end`, before, after or between the parts that are known. It may
    // overlap them a little: frames' times are not those of the records.
    insert(part, end) {
        for (const [camera, states] of part.shots) {
            const last = states[states.length - 1];
            const closed = last.flags === null ? states : [...states, {t: end, target: last.target, flags: null}];
            if (!this.shots.has(camera)) this.shots.set(camera, []);
            this.insertStates(this.shots.get(camera), closed, end);
        }
        this.insertMarks(this.cuts, part.cuts);
        this.insertMarks(this.events, part.events);
        this.insertMarks(this.latencies, part.latencies);
    }

    // Of parts that overlap each ends where the next one begins.
    insertStates(states, more, end) {
        const at = indexAfter(states, Math.max(more[0].t, end - maxGapMs));  // where later parts begin
        const next = states[at]?.t ?? Infinity;
        for (let i = at - 1; i >= 0 && states[i].t > more[0].t; --i) states[i].t = more[0].t;
        states.splice(at, 0, ...more.map(state => ({...state, t: Math.min(state.t, next)})));
        Timeline.join(states, at + more.length - 1);
        Timeline.join(states, at - 1);
        if (states.length > this.maxStates) states.splice(0, states.length - this.maxStates);
    }

    // The end at this index is none where the shot goes on.
    static join(states, index) {
        const next = states[index + 1];
        if (states[index]?.flags !== null || !next || next.t - states[index].t > maxGapMs) return;
        const before = states[index - 1];
        states.splice(index, before && isSame(before, next) ? 2 : 1);
    }

    insertMarks(marks, more) {
        if (more.length === 0) return;
        const sorted = [...more].sort(byTime);
        const from = indexAfter(marks, sorted[0].t);
        const to = indexAfter(marks, sorted[sorted.length - 1].t);
        marks.splice(from, to - from, ...[...marks.slice(from, to), ...sorted].sort(byTime));
        if (marks.length > this.maxMarks) marks.splice(0, marks.length - this.maxMarks);
    }

    // Spans of a shot between two times: [{from, to, target, flags}].
    spans(camera, from, to) {
        const states = this.shots.get(camera) ?? [];
        const spans = [];
        for (let i = Math.max(indexAfter(states, from) - 1, 0); i < states.length && states[i].t < to; ++i) {
            const {t, target, flags} = states[i];
            const end = states[i + 1]?.t ?? to;
            if (flags !== null && end > from) spans.push({from: Math.max(t, from), to: Math.min(end, to), target, flags});
        }
        return spans;
    }

    cutBetween(camera, from, to) {
        for (let i = indexAfter(this.cuts, from); i < this.cuts.length && this.cuts[i].t <= to; ++i)
            if (this.cuts[i].camera === camera) return true;
        return false;
    }

    // The latest cut of a shot at or before t.
    cutBefore(camera, t) {
        for (let i = indexAfter(this.cuts, t) - 1; i >= 0; --i)
            if (this.cuts[i].camera === camera) return this.cuts[i];
        return null;
    }

    // The first cut of a shot after t.
    cutAfter(camera, t) {
        for (let i = indexAfter(this.cuts, t); i < this.cuts.length; ++i)
            if (this.cuts[i].camera === camera) return this.cuts[i];
        return null;
    }

    forget(before) {
        for (const marks of [this.cuts, this.events, this.latencies])
            while (marks.length > 0 && marks[0].t < before) marks.shift();
        for (const [id, states] of this.shots) {
            // The first one that is kept says how the shot was when the time kept began.
            while (states.length > 1 && states[1].t <= before) states.shift();
            if (states.length === 1 && states[0].flags === null && states[0].t <= before) this.shots.delete(id);
        }
    }
}
