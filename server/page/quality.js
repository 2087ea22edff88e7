// How finely the match is drawn: as finely as this machine draws smoothly, 60 pictures a second.

// From the finest. scale: of the screen's resolution; mostPixels: of the picture, whatever the scale; smallEvery: so many
// pictures bring one of the small ones up to date, 0: each brings all; edges: of the map are drawn.
export const levels = [
    {scale: 1, smallEvery: 0, edges: true},
    {scale: 1, smallEvery: 1, edges: true},
    {scale: 0.75, smallEvery: 1, edges: true},
    {scale: 0.5, smallEvery: 1, edges: true},
    {scale: 0.5, smallEvery: 2, edges: false},
    {scale: 0.35, smallEvery: 2, edges: false},
    {scale: 0.35, mostPixels: 160e3, smallEvery: 4, edges: false},
];

const worst = levels.length - 1;
const processorPixels = 120e3;
const fewestPixels = 90e3;  // below which fewer save nothing

// The scale of a level for a screen of so many pixels.
export function scaleOf({scale, mostPixels = Infinity}, pixels) {
    const wanted = Math.min(scale, Math.sqrt(mostPixels / pixels));
    return Math.max(wanted, Math.min(Math.sqrt(fewestPixels / pixels), 1));
}

// The level to begin with for a picture of so many pixels where no graphics card draws it.
export function levelOfProcessor(pixels) {
    const found = levels.findIndex(({scale, smallEvery}) => smallEvery > 0 && scale * scale * pixels <= processorPixels);
    return found < 0 ? worst : found;
}

const smoothRate = 60;        // pictures a second
const missingOfSlow = 2;      // pictures, in a window: what is not smooth
const missingOfTrial = 3;     // likewise, in all of a trial
const reserveOfTrial = 1.2;   // of the scale: a level is tried with more pixels, lest it be just smooth
const gain = 1.05;            // of the rate, by less than which a coarser level is no help
const windowMs = 1000;        // over which the rate is measured
const fewestFrames = 4;       // in a window
const settleMs = 300;         // after a change, which itself takes time
const longestFrameMs = 150;   // while it settles: a longer one is a pause
const provingMs = 5e3;        // for which a level must be smooth
const firstWaitMs = 5e3;      // until a finer level is tried
const firstWaitOfProcessorMs = 20e3;
const lastingMs = 60e3;       // for which a level must be smooth to be tried as soon again
const longestWaitMs = 300e3;
const firstDoubtMs = 60e3;    // until a display that seems to show no more is asked again
const longestDoubtMs = 1200e3;

export class Quality {
    // hasCard: a graphics card draws, and is fast as soon as the map is there.
    constructor(level, hasCard) {
        this.level = level;
        this.hasCard = hasCard;
        this.firstWaitMs = hasCard ? firstWaitMs : firstWaitOfProcessorMs;
        this.wantedRate = smoothRate;  // less where this machine or its display has no more
        this.doubtMs = firstDoubtMs;
        this.doubtedMs = 0;            // since it was asked last
        this.last = -Infinity;         // time of the last frame
        this.restart();
    }

    // Another picture is drawn from now on: what was found out about the levels may not hold. What the display shows does.
    restart() {
        this.waitsMs = levels.map(() => this.firstWaitMs);  // how long a coarser level is smooth before this one is tried
        this.proved = this.hasCard;                    // one slow window says little then
        this.onTrial = false;                          // this level is finer than the last one, which was smooth
        this.level = this.descent?.level ?? this.level;
        this.descent = null;                           // the level and the rate that this one is to improve on
        this.settle();
    }

    settle() {
        this.settlingMs = settleMs;
        this.smoothMs = this.smoothPictures = 0;  // on this level
        this.missing = 0;                         // pictures of a trial
        this.slowWindows = 0;
        this.beginWindow();
    }

    beginWindow() {
        Object.assign(this, {frames: 0, drawn: 0, elapsedMs: 0, longestMs: 0});
    }

    // The browser's next frame, at this time in ms, and whether something is drawn in it.
    frame(at, drew) {
        const ms = at - this.last;
        this.last = at;
        if (this.settlingMs > 0) {
            this.settlingMs -= Math.min(ms, longestFrameMs);
            return;
        }
        ++this.frames;
        if (drew) ++this.drawn;
        this.elapsedMs += ms;
        this.longestMs = Math.max(this.longestMs, ms);
        // Without the longest of the intervals, in which the page may have been hidden, or the map was read.
        const measuredMs = this.elapsedMs - this.longestMs;
        if (measuredMs < windowMs || this.frames < fewestFrames) return;
        if (this.drawn > this.frames / 2) this.judge((this.frames - 1) * 1000 / measuredMs, measuredMs);
        this.beginWindow();
    }

    // By which the level's scale is larger now.
    get reserve() {
        return this.onTrial ? reserveOfTrial : 1;
    }

    judge(rate, ms) {
        const missing = (this.wantedRate - rate) * ms / 1000;
        if (this.onTrial) this.missing += Math.max(0, (this.rateBefore - rate) * ms / 1000);
        if (missing >= missingOfSlow || this.missing >= missingOfTrial) this.slow(rate); else this.smooth(rate, ms);
        if (this.wantedRate < smoothRate) this.doubt(ms);
    }

    slow(rate) {
        if (this.onTrial) {
            this.waitLonger();
            this.change(this.level + 1);
            this.proved = true;
        } else if (!this.proved || ++this.slowWindows > 1) {
            if (this.proved && this.smoothMs < lastingMs) this.waitLonger();
            this.descend(rate);
        }
    }

    waitLonger() {
        this.waitsMs[this.level] = Math.min(2 * this.waitsMs[this.level], longestWaitMs);
    }

    // To a coarser level; where that is no help, to the coarsest, and back where that is none either.
    descend(rate) {
        const helps = this.descent === null || rate > gain * this.descent.rate;
        if (this.level < worst) {
            const further = rate < this.wantedRate / 2 ? 2 : 1;
            this.descent ??= {level: this.level, rate};
            this.change(helps ? this.level + further : worst);
            this.proved = false;
        } else {
            this.wantedRate = rate;
            if (!helps) this.change(this.descent.level);
            this.descent = null;
        }
    }

    smooth(rate, ms) {
        this.slowWindows = 0;
        this.descent = null;
        if (rate > gain * this.wantedRate && this.wantedRate < smoothRate) return this.expectMore();
        this.smoothMs += ms;
        this.smoothPictures += rate * ms / 1000;
        if (this.smoothMs < provingMs) return;
        if (this.onTrial) this.settlingMs = settleMs;  // without the reserve
        this.proved = true;
        this.onTrial = false;
        this.missing = 0;
        if (this.smoothMs >= lastingMs) this.waitsMs[this.level] = this.firstWaitMs;
        if (this.level === 0 || this.smoothMs < this.waitsMs[this.level - 1]) return;
        this.rateBefore = Math.min(this.smoothPictures * 1000 / this.smoothMs, this.wantedRate);
        this.change(this.level - 1);
        this.onTrial = true;
    }

    // Whether the coarsest level is still no help.
    doubt(ms) {
        this.doubtedMs += ms;
        if (this.doubtedMs < this.doubtMs || this.onTrial || this.level === worst) return;
        this.descent = {level: this.level, rate: this.wantedRate};
        this.wantedRate = smoothRate;
        this.doubtMs = Math.min(2 * this.doubtMs, longestDoubtMs);
        this.doubtedMs = 0;
        this.proved = false;
        this.change(worst);
    }

    expectMore() {
        this.wantedRate = smoothRate;
        this.doubtMs = firstDoubtMs;
        this.doubtedMs = 0;
    }

    change(level) {
        this.level = Math.min(level, worst);
        this.onTrial = false;
        this.settle();
    }
}
