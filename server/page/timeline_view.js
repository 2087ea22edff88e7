// Draws the timeline: the shown camera's shot above, the others below it, cuts and events as marks.
import {columnsOf, lateMs} from './latency.js';
import {cameraFlag} from './protocol.js';
import {clockText} from './words.js';

const colours = {visible: '#7cc4ff', hidden: '#ffc857', searching: '#ffc857', fixed: '#c4ccd6', held: '#55606e', absent: '#3a434f'};
const spanMs = 5 * 60e3;
const steps = [1, 2, 5, 10, 30, 60, 120, 300, 600, 1800, 3600].map(s => s * 1000);  // between times
const minLabelPx = 56;
const timesPx = 12;
const latencyPx = 11;
const leastFullLatencyMs = 50;  // that fills the height
const thinFromMs = 10 * 60e3;  // of a timeline: cuts are thin lines

const reasons = {
    begin: 'the shot begins',
    target: 'another player, or a fixed camera',
    moved: 'the player respawned or was moved',
    hidden: 'the player was out of sight',
    viewpoint: 'a better viewpoint',
};

// Of an automatic shot the moment that it shows, and of whom.
export function reasonText(cut, nameOf) {
    if (!cut.moment) return reasons[cut.reason] ?? cut.reason;
    const players = [cut.moment.actor, cut.moment.subject].filter(slot => slot !== null).map(nameOf);
    return players.length > 0 ? `${cut.moment.rule}, ${players.join(' and ')}` : cut.moment.rule;
}

// What a shot does: visible, hidden, searching, fixed, held, absent.
export function modeOf({target, flags}) {
    if (flags & cameraFlag.absent) return 'absent';
    if (flags & cameraFlag.searching) return 'searching';
    if (flags & cameraFlag.held) return 'held';
    if (flags & cameraFlag.visible) return 'visible';
    return target === null ? 'fixed' : 'hidden';
}

const modeTexts = {visible: 'In view', hidden: 'Out of sight', searching: 'Searching', fixed: 'Stands still', held: 'Held', absent: 'Absent'};
const groupTexts = {...modeTexts, visible: 'All living in view', searching: 'Not all in view'};

// In words; `isOfGroup`: the shot is of several players.
export function modeText(shot, isOfGroup) {
    return (isOfGroup ? groupTexts : modeTexts)[modeOf(shot)];
}

// {stamp, slots}: a number that changes with all that is drawn of a timeline, and the players in it.
function stampOf({shots, cuts, events, latencies}) {
    let stamp = 0;
    const slots = new Set();
    const take = value => { stamp = Math.imul(stamp ^ (value ?? -1), 0x01000193) + 1 | 0; };
    for (const [id, states] of shots) {
        take(id);
        for (const {t, target, flags} of states) {
            take(t);
            take(target);
            take(flags);
            slots.add(target);
        }
    }
    for (const {t, camera} of cuts) {
        take(t);
        take(camera);
    }
    for (const {t, actor} of events) {
        take(t);
        slots.add(actor);
    }
    for (const {t, ms} of latencies) {
        take(t);
        take(ms);
    }
    return {stamp, slots};
}

// What was drawn last: nothing.
const blank = {key: '', from: 0, to: 0};

export class TimelineView {
    constructor(element) {
        this.element = element;
        this.canvas = element.querySelector('canvas');
        this.cursor = element.querySelector('i');
        this.context = this.canvas.getContext('2d');
        this.drawn = blank;
    }

    // The times at both ends: of a whole recording, or of the last minutes.
    range(first, last, whole) {
        if (whole) return [first, Math.max(last, first + 1)];
        const span = Math.min(Math.max(last - first, 30e3), spanMs);
        return [last - span, last];
    }

    timeAt(clientX, first, last, whole) {
        const {left, width} = this.element.getBoundingClientRect();
        const [from, to] = this.range(first, last, whole);
        return from + Math.min(Math.max((clientX - left) / width, 0), 1) * (to - from);
    }

    clear() {
        if (this.drawn === blank) return;
        this.drawn = blank;
        this.context.clearRect(0, 0, this.element.clientWidth, this.element.clientHeight);
        this.cursor.hidden = true;
    }

    // `delayMs`: of the match, which is no latency. The picture is drawn when something in it is another than in the last one,
    // or has moved by half a pixel.
    draw({timeline, camera, t, first, last, whole, delayMs, colourOfSlot}) {
        const {clientWidth: width, clientHeight: height} = this.element;
        const [from, to] = this.range(first, last, whole);
        const {stamp, slots} = stampOf(timeline);
        const bySlot = new Map([...slots].map(slot => [slot, colourOfSlot(slot)]));
        const key = [stamp, camera, delayMs, width, height, devicePixelRatio, ...bySlot.values()].join(' ');
        const moved = Math.max(Math.abs(from - this.drawn.from), Math.abs(to - this.drawn.to)) / (to - from) * width;
        const x = time => (time - from) / (to - from) * width;
        if (key !== this.drawn.key || moved > 0.5) {
            this.drawn = {key, from, to};
            this.drawPicture({timeline, camera, first, whole, delayMs, from, to, x, width, height,
                colourOfSlot: slot => bySlot.get(slot)});
        }
        this.cursor.hidden = false;
        this.cursor.style.transform = `translateX(${Math.min(Math.round(x(t)), width - 2) - 1}px)`;
    }

    drawPicture({timeline, camera, first, whole, delayMs, from, to, x, width, height, colourOfSlot}) {
        const ratio = devicePixelRatio;
        if (this.canvas.width !== Math.round(width * ratio) || this.canvas.height !== Math.round(height * ratio)) {
            this.canvas.width = Math.round(width * ratio);
            this.canvas.height = Math.round(height * ratio);
        }
        const c = this.context;
        c.setTransform(ratio, 0, 0, ratio, 0, 0);
        c.clearRect(0, 0, width, height);
        const latencies = columnsOf(timeline.latencies, from, to, width);
        const greatest = latencies.reduce((most, each) => Math.max(most, each), -1);
        const bottom = height - timesPx - (greatest >= 0 ? latencyPx + 1 : 0);  // of the shots
        const middle = (bottom + timesPx) * 0.42;
        c.fillStyle = '#ffffff10';
        c.fillRect(0, middle - 6, width, 12);
        for (const span of timeline.spans(camera, from, to)) this.drawSpan(c, span, x, middle, colourOfSlot);
        const others = this.othersOf(timeline, camera, from, to);
        const room = Math.floor(bottom - middle - 13);  // for rows of a pixel
        this.drawOthers(c, others.slice(0, room), x, middle + 13, bottom, colourOfSlot);
        c.fillStyle = '#ffffff';
        const cutWidth = to - from > thinFromMs ? 1 : 2;
        for (const cut of timeline.cuts)
            if (cut.camera === camera && cut.t >= from) c.fillRect(Math.round(x(cut.t)) - 1, middle - 11, cutWidth, 22);
        for (const event of timeline.events) this.drawEvent(c, event, x, middle - 13, colourOfSlot);
        this.drawTimes(c, from, to, whole ? from : null, x, height, width);
        const unseen = x(Math.max(first, from));
        c.fillStyle = '#0d1014aa';
        c.fillRect(0, 0, unseen, height - timesPx);
        if (others.length > room)
            this.drawWords(c, `${others.length - room} of ${others.length} other cameras are not drawn`, bottom);
        if (greatest >= 0) this.drawLatencies(c, latencies, greatest, delayMs, height - timesPx);
    }

    drawSpan(c, span, x, middle, colourOfSlot) {
        const mode = modeOf(span);
        const left = x(span.from);
        const width = Math.max(x(span.to) - left, 0.5);
        c.fillStyle = mode === 'visible' ? colourOfSlot(span.target) : colours[mode];
        if (mode === 'hidden' || mode === 'searching') {
            c.globalAlpha = 0.35;
            c.fillRect(left, middle - 6, width, 12);
            c.globalAlpha = 1;
        }
        if (mode === 'hidden') {
            for (let at = Math.ceil(left / 4) * 4; at < left + width; at += 4) c.fillRect(at, middle - 6, 1.5, 12);
        } else if (mode === 'searching') {
            for (const edge of [-6, 4]) c.fillRect(left, middle + edge, width, 2);
        } else {
            const half = mode === 'held' || mode === 'absent' ? 2 : 6;
            c.fillRect(left, middle - half, width, 2 * half);
        }
    }

    // The spans of each of the other cameras that has some.
    othersOf(timeline, camera, from, to) {
        const ids = [...timeline.shots.keys()].filter(id => id !== camera).sort((a, b) => a - b);
        return ids.map(id => timeline.spans(id, from, to)).filter(spans => spans.length > 0);
    }

    drawOthers(c, others, x, top, bottom, colourOfSlot) {
        const each = Math.min((bottom - top) / others.length, 4);
        c.globalAlpha = 0.65;
        others.forEach((spans, row) => {
            for (const span of spans) {
                const mode = modeOf(span);
                const tall = Math.max(each - 1, 1) * (mode === 'visible' ? 1 : 0.4);  // not by colour alone
                c.fillStyle = mode === 'visible' ? colourOfSlot(span.target) : colours[mode];
                c.fillRect(x(span.from), top + row * each, Math.max(x(span.to) - x(span.from), 0.5), tall);
            }
        });
        c.globalAlpha = 1;
    }

    drawEvent(c, event, x, y, colourOfSlot) {
        if (event.event !== 'kill') return;
        c.fillStyle = event.actor === null ? '#9aa6b5' : colourOfSlot(event.actor);
        c.beginPath();
        c.moveTo(x(event.t), y + 1);
        c.lineTo(x(event.t) - 3.5, y - 6);
        c.lineTo(x(event.t) + 3.5, y - 6);
        c.fill();
    }

    // `latencies`: of each column, with the greatest in words.
    drawLatencies(c, latencies, greatest, delayMs, bottom) {
        const scale = latencyPx / Math.max(lateMs(greatest, delayMs), leastFullLatencyMs);
        c.fillStyle = '#9aa6b5';
        latencies.forEach((latency, column) => {
            const tall = Math.max(lateMs(latency, delayMs) * scale, 0.5);
            if (latency >= 0) c.fillRect(column, bottom - tall, 1, tall);
        });
        this.drawWords(c, `latency up to ${Math.round(lateMs(greatest, delayMs))} ms`, bottom);
    }

    // At the left.
    drawWords(c, text, bottom) {
        c.font = '9.5px system-ui, sans-serif';
        c.textAlign = 'left';
        c.fillStyle = '#0d1014cc';
        c.fillRect(2, bottom - latencyPx, c.measureText(text).width + 4, latencyPx);
        c.fillStyle = '#ffffff';
        c.fillText(text, 4, bottom - 2);
    }

    // Since `origin`, or before the end where that is null.
    drawTimes(c, from, to, origin, x, height, width) {
        c.fillStyle = '#9aa6b5';
        c.font = '10.5px system-ui, sans-serif';
        c.textAlign = 'center';
        const step = steps.find(each => each / (to - from) * width > minLabelPx) ?? steps[steps.length - 1];
        for (let distance = step; distance < to - from; distance += step) {
            const at = x(origin === null ? to - distance : origin + distance);
            if (at < 18 || at > width - 18) continue;
            const before = distance % 60e3 === 0 ? `−${distance / 60e3} min` : `−${distance / 1e3} s`;
            c.fillText(origin === null ? before : clockText(distance, false), at, height - 1);
            c.fillRect(Math.round(at), height - 13, 1, 3);
        }
    }
}
