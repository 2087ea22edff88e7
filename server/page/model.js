// The match that is watched, wherever it comes from: its players, its frames, its timeline, and the time that is shown.
import {colourOf, nameOf} from './palette.js';
import {FrameBuffer, PlayoutClock} from './playout.js';
import {Timeline} from './timeline.js';

export class Model {
    // Forgets everything for what a source has of another match, of which so much is `kept`: framesMs, timing of the
    // clock, bounds of the timeline.
    begin(kept) {
        this.kept = kept;
        this.note = null;         // the match's
        this.players = new Map(); // by slot
        this.buffer = new FrameBuffer(kept.framesMs);
        this.clock = new PlayoutClock(kept.timing);
        this.timeline = this.newTimeline();
    }

    newTimeline() {
        return new Timeline(this.kept.timeline);
    }

    setMatch(note) {
        this.note = note;
        this.players = new Map(note.players.map(player => [player.slot, player]));
    }

    // How a player is shown; null: nobody.
    look(slot) {
        const player = this.players.get(slot);
        return {colour: slot === null ? '#9aa6b5' : colourOf(player, [...this.players.values()]), name: nameOf(player),
            number: slot === null ? '–' : String(slot + 1)};
    }

    // What is seen now; null: nothing yet.
    sample() {
        if (this.clock.t === null) return null;
        return this.buffer.sample(this.clock.t, (camera, from, to) => this.timeline.cutBetween(camera, from, to));
    }

    // The nearest cut of a camera within this time of t.
    cutNear(camera, t, within) {
        const near = [this.timeline.cutBefore(camera, t), this.timeline.cutAfter(camera, t)]
            .filter(cut => cut && Math.abs(cut.t - t) < within);
        return near.sort((a, b) => Math.abs(a.t - t) - Math.abs(b.t - t))[0] ?? null;
    }
}
