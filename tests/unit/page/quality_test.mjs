// The adaptive quality of the window, on simulated machines.
import assert from 'node:assert/strict';
import {test} from 'node:test';
import {Quality, levelOfProcessor, levels, scaleOf} from '../../../server/page/quality.js';

const worst = levels.length - 1;

// A display of so many ms a frame; `costMs(level, at)`: what a picture takes. Runs from `at` for so many seconds and returns
// the time and the levels of each second.
function run(quality, seconds, costMs, {at = 0, displayMs = 1000 / 60, draws = () => true} = {}) {
    const seen = [];
    for (const end = at + seconds * 1000; at < end;) {
        const drew = draws(at);
        quality.frame(at, drew);
        at += Math.max(displayMs, drew ? costMs(quality.level, at) : 0);
        seen[Math.floor(at / 1000)] = quality.level;
    }
    return {at, seen: seen.filter(level => level !== undefined)};
}

test('a fast machine draws as finely as there is, from wherever it begins', () => {
    for (const first of [0, 2, worst]) {
        const quality = new Quality(first, true);
        const {seen} = run(quality, 60, () => 5);
        assert.equal(quality.level, 0);
        assert.ok(seen.every((level, i) => i === 0 || level <= seen[i - 1]), `${seen}`);
    }
});

test('a slow machine comes to the finest level that is smooth, and is rarely bothered by trials of a finer one', () => {
    const quality = new Quality(0, true);
    const costs = [200, 60, 25, 12, 9, 8, 7];
    const begin = run(quality, 30, level => costs[level]);
    const {seen} = run(quality, 600, level => costs[level], begin);
    assert.ok(seen.every(level => level === 3 || level === 2));
    assert.ok(seen.filter(level => level === 2).length < 40, `${seen}`);
});

test('a trial of a level that is not smooth ends with its first window', () => {
    const quality = new Quality(worst, true);
    const {seen} = run(quality, 60, level => level === worst ? 8 : 18);
    assert.ok(seen.includes(worst - 1));
    assert.ok(seen.every((level, i) => level === worst || seen[i + 2] === worst), `${seen}`);
});

test('a level that has proved to be smooth outlasts a slow window', () => {
    const quality = new Quality(1, true);
    const proved = run(quality, 60, () => 5);
    assert.equal(quality.level, 0);
    const {seen} = run(quality, 10, (level, at) => at < proved.at + 1000 ? 18 : 5, proved);
    assert.ok(seen.every(level => level === 0), `${seen}`);
});

test('where no level is smooth it stays at the last one, or where the same rate is reached', () => {
    const quality = new Quality(0, true);
    const {seen} = run(quality, 600, level => 160 - 20 * level);
    assert.equal(quality.level, worst);
    assert.ok(seen.filter(level => level !== worst).length < 60, `${seen}`);
});

test('a display that shows 30 frames a second keeps the finest level', () => {
    const quality = new Quality(0, true);
    const begin = run(quality, 90, () => 5, {displayMs: 1000 / 30});
    assert.equal(quality.level, 0);
    assert.ok(run(quality, 60, () => 5, {...begin, displayMs: 1000 / 30}).seen.every(level => level === 0));
});

test('a busy machine is drawn coarsely for, and finely again when it is not busy any more', () => {
    const quality = new Quality(0, true);
    const busy = run(quality, 30, level => 70 - 10 * level);
    assert.equal(quality.level, worst);
    run(quality, 90, () => 5, busy);
    assert.equal(quality.level, 0);
});

test('frames in which nothing is drawn say nothing, nor does the time in which the page is hidden', () => {
    const quality = new Quality(3, true);
    const paused = run(quality, 60, () => 5, {draws: () => false});
    assert.equal(quality.level, 3);
    run(quality, 2, () => 5, {at: paused.at + 600e3});
    assert.equal(quality.level, 3);
});

test('without a graphics card it begins coarsely, but on a small screen', () => {
    assert.equal(levels[levelOfProcessor(360 * 240)].scale, 1);
    assert.equal(levels[levelOfProcessor(1000 * 600)].scale, 0.5);
    assert.equal(levelOfProcessor(1e9), worst);
});

test('a small screen is never drawn less finely, a large one as its level says', () => {
    for (const level of levels) {
        assert.equal(scaleOf(level, 360 * 240), 1);
        assert.equal(scaleOf(level, 4e6), level.scale);
    }
});
