// How finely the match is drawn: as finely as this machine draws smoothly, 60 pictures a second.

// From the finest. scale: of the screen's resolution; smallEvery: so many pictures bring one of the small ones up to date, 0:
// each brings all; edges: of the map are drawn.
export const levels = [
    {scale: 1, smallEvery: 0, edges: true},
    {scale: 1, smallEvery: 1, edges: true},
    {scale: 0.75, smallEvery: 1, edges: true},
    {scale: 0.5, smallEvery: 1, edges: true},
    {scale: 0.5, smallEvery: 2, edges: false},
    {scale: 0.35, smallEvery: 2, edges: false},
    {scale: 0.35, smallEvery: 4, edges: false},
];

const processorPixels = 160e3;
const fewestPixels = 90e3;  // below which fewer save nothing

// The scale of a level for a screen of so many pixels.
export function scaleOf({scale}, pixels) {
    return Math.max(scale, Math.min(Math.sqrt(fewestPixels / pixels), 1));
}

// The level to begin with for a picture of so many pixels where no graphics card draws it.
export function levelOfProcessor(pixels) {
    const found = levels.findIndex(({scale, smallEvery}) => smallEvery > 0 && scale * scale * pixels <= processorPixels);
    return found < 0 ? levels.length - 1 : found;
}

const smoothRate = 59;      // pictures a second
const tolerance = 0.975;    // of the rate that is wanted
const windowMs = 1000;      // over which the rate is measured
const settleMs = 300;       // after a change, which itself takes time
const firstPatienceMs = 5e3;
const longestPatienceMs = 300e3;

export class Quality {
    // hasCard: a graphics card draws, and is fast as soon as the map is there.
    constructor(level, hasCard) {
        this.level = level;
        this.wantedRate = smoothRate;
        this.patienceMs = firstPatienceMs;  // how long it is smooth before a finer level is tried
        this.onTrial = false;               // this level is finer than the last one was: one slow window ends it
        this.slowWindows = 0;
        this.smoothSince = null;
        this.wasSmooth = hasCard;           // ever: until then a coarser level is found soon
        this.beginWindow(-Infinity);
    }

    // At the frame at this time, or at the last one before all has settled.
    beginWindow(at, untilSettledMs = 0) {
        Object.assign(this, {from: at, last: at, settledAt: at + untilSettledMs, frames: 0, drawn: 0});
    }

    // The browser's next frame, at this time in ms, and whether something is drawn in it.
    frame(at, drew) {
        if (at - this.last > windowMs) return this.beginWindow(at);  // the first, or the page was hidden
        this.last = at;
        if (at < this.settledAt) {
            this.from = at;
            return;
        }
        ++this.frames;
        if (drew) ++this.drawn;
        if (at - this.from < windowMs) return;
        const rate = this.frames * 1000 / (at - this.from);
        const before = this.level;
        if (this.drawn > this.frames / 2) if (rate < tolerance * this.wantedRate) this.slow(rate); else this.smooth(rate, at);
        this.beginWindow(at, this.level === before ? 0 : settleMs);
    }

    slow(rate) {
        this.smoothSince = null;
        const isHalf = rate < this.wantedRate / 2;
        if (this.level === levels.length - 1) {
            this.wantedRate = rate;  // this machine or its display has no more
        } else if (isHalf || !this.wasSmooth || this.onTrial || ++this.slowWindows > 1) {
            if (this.onTrial) this.patienceMs = Math.min(2 * this.patienceMs, longestPatienceMs);
            this.change(isHalf ? 2 : 1);
            this.onTrial = false;
        }
    }

    smooth(rate, at) {
        this.slowWindows = 0;
        this.wasSmooth = true;
        this.wantedRate = Math.min(Math.max(this.wantedRate, rate), smoothRate);
        this.smoothSince ??= at;
        if (at - this.smoothSince < this.patienceMs) return;
        if (this.onTrial) this.patienceMs = firstPatienceMs;
        this.onTrial = this.level > 0;
        if (this.onTrial) this.change(-1);
    }

    change(by) {
        this.level = Math.min(this.level + by, levels.length - 1);
        this.slowWindows = 0;
        this.smoothSince = null;
    }
}
