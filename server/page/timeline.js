// What happened in the last minutes: how each shot went, cuts with their reasons, events.
import {cameraFlag} from './protocol.js';

const keptMs = 5 * 60e3;
const maxStates = 4096;  // of a shot
const maxMarks = 1024;

export class Timeline {
    constructor() {
        this.clear();
    }

    clear() {
        this.shots = new Map();  // by camera: [{t, target, flags}], flags null: the shot has ended
        this.cuts = [];
        this.events = [];
    }

    addState(t, camera, target, flags) {
        if (!this.shots.has(camera)) this.shots.set(camera, []);
        const states = this.shots.get(camera);
        const last = states[states.length - 1];
        const shown = flags === null ? null : flags & ~cameraFlag.cut;
        if (last && (t <= last.t || (last.flags === shown && last.target === target))) return;
        states.push({t, target, flags: shown});
        if (states.length > maxStates) states.shift();
    }

    // The shots of a frame.
    addFrame(frame) {
        for (const [id, camera] of frame.cameras) this.addState(frame.t, id, camera.target, camera.flags);
        for (const [id, states] of this.shots) {
            const last = states[states.length - 1];
            if (!frame.cameras.has(id) && last.flags !== null) this.addState(frame.t, id, last.target, null);
        }
        this.forget(frame.t - keptMs);
    }

    addNote(note) {
        const marks = note.kind === 'cut' ? this.cuts : this.events;
        marks.push(note);
        if (marks.length > maxMarks) marks.shift();
    }

    addHistory(history) {
        for (const [t, camera, target, flags] of history.states) this.addState(t, camera, target, flags);
        for (const note of history.notes) this.addNote(note);
    }

    // Spans of a shot between two times: [{from, to, target, flags}].
    spans(camera, from, to) {
        const states = this.shots.get(camera) ?? [];
        const spans = [];
        states.forEach((state, i) => {
            const end = states[i + 1]?.t ?? to;
            if (state.flags === null || end <= from || state.t >= to) return;
            spans.push({from: Math.max(state.t, from), to: Math.min(end, to), target: state.target, flags: state.flags});
        });
        return spans;
    }

    cutBetween(camera, from, to) {
        return this.cuts.some(cut => cut.camera === camera && cut.t > from && cut.t <= to);
    }

    // The latest cut of a shot at or before t.
    cutBefore(camera, t) {
        return this.cuts.filter(cut => cut.camera === camera && cut.t <= t).pop() ?? null;
    }

    forget(before) {
        while (this.cuts.length > 0 && this.cuts[0].t < before) this.cuts.shift();
        while (this.events.length > 0 && this.events[0].t < before) this.events.shift();
        for (const [id, states] of this.shots) {
            // The first one that is kept says how the shot was when the time kept began.
            while (states.length > 1 && states[1].t <= before) states.shift();
            if (states.length === 1 && states[0].flags === null && states[0].t <= before) this.shots.delete(id);
        }
    }
}
