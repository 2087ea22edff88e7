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
        this.known = new Map();   // by slot: as players were at other times
        this.looks = new Map();   // by slot
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
        this.looks.clear();
    }

    // Players of other times: those who are yet to come, or have left, are shown by them.
    setKnown(players) {
        this.known = new Map(players.map(player => [player.slot, player]));
        this.looks.clear();
    }

    // How a player is shown; null: nobody.
    look(slot) {
        if (!this.looks.has(slot)) this.looks.set(slot, this.makeLook(slot));
        return this.looks.get(slot);
    }

    makeLook(slot) {
        const shown = this.players.get(slot);
        const player = shown?.listed ? shown : this.known.get(slot) ?? shown;
        const all = [...this.known.values(), ...this.players.values()];
        return {colour: slot === null ? '#9aa6b5' : colourOf(player, all), name: nameOf(player),
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
