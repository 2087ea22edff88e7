// The adaptive quality of the window, on simulated machines.
import assert from 'node:assert/strict';
import {test} from 'node:test';
import {Quality, levelOfProcessor, levels, scaleOf} from '../../../server/page/quality.js';

const worst = levels.length - 1;
const fast = () => 5;
const second = 1000;
const minute = 60 * second;

// What a machine draws from `at` on, and the level of each second. costMs(level, at): what a picture takes; a display of
// `hz`; changeMs: what a change of the level takes; extraMs(at): by which a frame is late.
class Machine {
    constructor(quality) {
        Object.assign(this, {quality, at: 0, drawnLevel: quality.level, drawnReserve: 1, changes: 0});
    }

    run(ms, costMs, {hz = 60, draws = true, changeMs = 0, extraMs = () => 0} = {}) {
        const seen = [];
        for (const end = this.at + ms; this.at < end;) {
            this.quality.frame(this.at, draws);
            const {level, reserve} = this.quality;
            const changed = level !== this.drawnLevel || reserve !== this.drawnReserve;
            this.changes += level !== this.drawnLevel;
            Object.assign(this, {drawnLevel: level, drawnReserve: reserve});
            this.at += Math.max(second / hz, draws ? costMs(level, this.at) : 0) + (changed ? changeMs : 0) + extraMs(this.at);
            seen[Math.floor((ms - end + this.at) / second)] = level;
        }
        return seen.filter(level => level !== undefined);
    }
}

const share = (seen, level) => seen.filter(one => one === level).length / seen.length;

// Lets a frame be lost so many times a second, at random but the same ones in every run.
function losing(perSecond, hz) {
    let state = 1;
    return () => {
        state = (state * 48271) % 2147483647;
        return state / 2147483647 < perSecond / hz ? second / hz : 0;
    };
}

test('a fast machine draws as finely as there is, from wherever it begins', () => {
    for (const first of [0, 2, worst]) {
        const machine = new Machine(new Quality(first, true));
        const seen = machine.run(minute, fast);
        assert.equal(machine.quality.level, 0);
        assert.ok(seen.every((level, i) => i === 0 || level <= seen[i - 1]), `${seen}`);
    }
});

test('a slow machine comes to the finest level that is smooth, and is rarely bothered by trials of a finer one', () => {
    for (const tooSlow of [25, 40]) {  // less, and more, than half too slow
        const costs = [200, 60, tooSlow, 12, 9, 8, 7];
        const machine = new Machine(new Quality(0, true));
        machine.run(minute / 2, level => costs[level]);
        machine.changes = 0;
        const seen = machine.run(30 * minute, level => costs[level]);
        assert.ok(share(seen, 3) > 0.97, `${seen}`);
        assert.ok(machine.changes < 40, `${machine.changes}`);
    }
});

test('a trial of a level that is not smooth ends with its first window', () => {
    const machine = new Machine(new Quality(worst, true));
    const seen = machine.run(minute, level => level === worst ? 8 : 18);
    assert.ok(seen.includes(worst - 1));
    assert.ok(seen.every((level, i) => level === worst || seen[i + 2] === worst), `${seen}`);
});

test('a level that is just smooth is left alone: it is tried with more pixels', () => {
    const machine = new Machine(new Quality(worst, false));
    const seen = machine.run(10 * minute, level => level === 4 ? 15 * machine.quality.reserve ** 2 : level > 4 ? 8 : 30);
    assert.ok(share(seen, 5) > 0.95, `${seen}`);
});

test('a level that has proved to be smooth outlasts a slow window', () => {
    const machine = new Machine(new Quality(1, true));
    machine.run(minute, fast);
    assert.equal(machine.quality.level, 0);
    const until = machine.at + second;
    const seen = machine.run(10 * second, (level, at) => at < until ? 18 : 5);
    assert.equal(share(seen, 0), 1);
});

test('58 pictures a second are smooth, 57 are not', () => {
    for (const [hz, smooth] of [[58.3, true], [57, false]]) {
        const machine = new Machine(new Quality(1, false));
        machine.run(minute, level => level > 1 ? 5 : second / hz);
        assert.equal(machine.quality.level, smooth ? 0 : 2, `${hz}`);
    }
});

test('where no level is smooth it stays at the last one, or where the same rate is reached', () => {
    const machine = new Machine(new Quality(0, true));
    const seen = machine.run(10 * minute, level => 160 - 20 * level);
    assert.equal(machine.quality.level, worst);
    assert.ok(share(seen, worst) > 0.9, `${seen}`);
});

test('whatever a display shows, it shows the finest level', () => {
    for (const hz of [24, 30, 48, 50, 57, 59.94, 75, 120, 144]) {
        const machine = new Machine(new Quality(0, true));
        machine.run(10 * second, fast, {hz});
        machine.changes = 0;
        const seen = machine.run(60 * minute, fast, {hz});
        assert.ok(share(seen, 0) > 0.995, `${hz}: ${share(seen, 0)}`);
        assert.ok(machine.changes <= 20, `${hz}: ${machine.changes}`);
    }
    for (const hz of [58.5, 59, 59.5, 60]) {
        const machine = new Machine(new Quality(worst, false));
        machine.run(4 * minute, fast, {hz});
        assert.equal(machine.quality.level, 0, `${hz}`);
    }
});

test('frames that are lost now and then do not make a fast machine coarse', () => {
    for (const [hz, perSecond, least] of [[30, 0.15, 0.95], [50, 0.5, 0.95], [60, 0.9, 0.95], [60, 1.2, 0.5]]) {
        const machine = new Machine(new Quality(0, true));
        const seen = machine.run(30 * minute, fast, {hz, extraMs: losing(perSecond, hz)});
        assert.ok(share(seen, 0) > least, `${hz} ${perSecond}: ${share(seen, 0)}`);
    }
});

test('a display that comes to show more is drawn for as smoothly', () => {
    const costs = [30, 22, 14, 10, 9, 8, 7];
    const machine = new Machine(new Quality(0, true));
    machine.run(2 * minute, level => costs[level], {hz: 30});
    assert.equal(machine.quality.level, 0);
    machine.run(minute, level => costs[level]);
    assert.equal(machine.quality.level, 2);
});

test('a busy machine is drawn coarsely for, and finely again when it is not busy any more', () => {
    const machine = new Machine(new Quality(0, true));
    machine.run(minute / 2, level => 80 - 10 * level);
    assert.equal(machine.quality.level, worst);
    machine.run(90 * second, fast);
    assert.equal(machine.quality.level, 0);
});

test('a machine that was too busy for any level finds the finest smooth one', () => {
    for (const busy of [minute, 3 * minute, 15 * minute]) {
        const costs = [50, 45, 40, 30, 14, 10, 9];
        const machine = new Machine(new Quality(4, false));
        machine.run(busy, level => Math.max(45, costs[level]));
        machine.run(25 * minute, level => costs[level]);
        assert.ok(share(machine.run(5 * minute, level => costs[level]), 4) > 0.95, `${busy}`);
    }
});

test('a hiccup now and then does not keep a machine coarse', () => {
    const machine = new Machine(new Quality(0, true));
    machine.run(15 * minute, level => 80 - 10 * level);
    let last = machine.at;
    const extraMs = at => {
        if (at - last < 4 * minute) return 0;
        last = at;
        return 100;
    };
    machine.run(40 * minute, fast, {extraMs});
    assert.equal(share(machine.run(20 * minute, fast, {extraMs}), 0), 1);
});

test('one pause costs nothing, however long', () => {
    for (const pause of [300, 600, 980, 3000, 600e3]) {
        const machine = new Machine(new Quality(0, true));
        machine.run(20 * second, fast);
        const from = machine.at + 300;
        let paused = false;
        const seen = machine.run(20 * second + pause, fast, {extraMs: at => {
            if (paused || at < from) return 0;
            paused = true;
            return pause;
        }});
        assert.equal(share(seen, 0), 1, `${pause}: ${seen}`);
    }
});

test('frames in which nothing is drawn say nothing, nor does the time in which the page is hidden', () => {
    const machine = new Machine(new Quality(3, true));
    machine.run(2.5 * second, fast);
    machine.run(minute, fast, {draws: false});
    assert.equal(machine.quality.level, 3);
    machine.at += 10 * minute;
    machine.run(2 * second, fast);
    assert.equal(machine.quality.level, 3);
    machine.run(2 * second, fast);
    assert.equal(machine.quality.level, 2);
});

test('a machine that is busy every few seconds is tried less and less', () => {
    const machine = new Machine(new Quality(2, true));
    const costMs = (level, at) => level < 2 && at % (9 * second) > 6 * second ? 25 : 8;
    machine.run(5 * minute, costMs);
    machine.changes = 0;
    machine.run(20 * minute, costMs);
    assert.ok(machine.changes < 30, `${machine.changes}`);
});

test('a display that is asked while another picture is chosen keeps its level', () => {
    const machine = new Machine(new Quality(0, true));
    for (const end = 20 * minute; machine.at < end;) {
        machine.run(second, fast, {hz: 30});
        if (machine.quality.level === worst) machine.quality.restart();
    }
    assert.equal(machine.quality.level, 0);
});

test('how long a change takes is not how long a picture takes', () => {
    const machine = new Machine(new Quality(worst, false));
    machine.run(3 * minute, () => 10, {changeMs: 700});
    assert.equal(machine.quality.level, 0);
});

test('where another picture is drawn all levels are open again', () => {
    const machine = new Machine(new Quality(2, false));
    machine.run(20 * minute, level => level < 2 ? 30 : 10);
    assert.equal(machine.quality.level, 2);
    machine.quality.restart();
    machine.run(minute, fast);
    assert.equal(machine.quality.level, 0);
});

test('without a graphics card it begins coarsely, but on a small screen', () => {
    assert.equal(levels[levelOfProcessor(360 * 240)].scale, 1);
    assert.equal(levels[levelOfProcessor(700 * 600)].scale, 0.5);
    assert.equal(levels[levelOfProcessor(1000 * 600)].scale, 0.35);
    assert.equal(levelOfProcessor(1e9), worst);
});

test('a small screen is never drawn less finely, a large one as its level says', () => {
    for (const level of levels) {
        assert.equal(scaleOf(level, 360 * 240), 1);
        assert.equal(scaleOf(level, 1e6), level.scale);
    }
    assert.equal(scaleOf(levels[0], 4e6), 1);
    assert.equal(scaleOf(levels[worst], 16e6), 0.1);
});
