import assert from 'node:assert/strict';
import {test} from 'node:test';
import {Timeline} from '../../../server/page/timeline.js';
import {TimelineView} from '../../../server/page/timeline_view.js';

const kept = {keptMs: Infinity, maxStates: 4096, maxMarks: 1024};

// Draws timelines of a minute, `size` in pixels: what is drawn is [{rectangle: [x, y, width, height], style}] and words.
function viewOf(size = {clientWidth: 600, clientHeight: 70}) {
    globalThis.devicePixelRatio = 1;
    const bars = [];
    const words = [];
    const context = {setTransform() {}, clearRect() {}, beginPath() {}, moveTo() {}, lineTo() {}, fill() {},
        measureText: text => ({width: 5 * text.length}), fillText: text => words.push(text),
        fillRect(...rectangle) { bars.push({rectangle, style: this.fillStyle, alpha: this.globalAlpha}); }};
    const canvas = {getContext: () => context};
    const cursor = {style: {}};
    const element = {querySelector: name => name === 'canvas' ? canvas : cursor, ...size};
    const view = new TimelineView(element);
    const draw = shown => view.draw({timeline: new Timeline(kept), camera: 5, t: 0, first: 0, last: 60e3, whole: true, delayMs: 0,
        colourOfSlot: () => '#000000', ...shown});
    return {bars, words, cursor, element, draw, view};
}

function drawn(timeline, delayMs) {
    const picture = viewOf();
    picture.draw({timeline, delayMs});
    return picture;
}

const heightsOf = ({bars}) => bars.filter(({rectangle: [, y, width, height], style}) => style === '#9aa6b5' && width === 1 && y + height === 58)
    .map(({rectangle: [x, , , height]}) => [x, height]);

test('latencies are bars as high as they are, and the greatest is in words', () => {
    const timeline = new Timeline(kept);
    timeline.addLatency(0, 10050);
    timeline.addLatency(30e3, 10100);
    timeline.addLatency(59e3, 9990);
    const picture = drawn(timeline, 10000);
    const heights = new Map(heightsOf(picture));
    assert.equal(heights.get(300), 2 * heights.get(0));
    assert.ok(heights.get(590) < 1, 'less than the delay is none');
    assert.equal(heights.has(150), false, 'nothing is known there');
    assert.ok(picture.words.includes('latency up to 100 ms'), picture.words.join());
});

test('where no latency is known none is drawn', () => {
    const picture = drawn(new Timeline(kept), 0);
    assert.deepEqual(heightsOf(picture), []);
    assert.deepEqual(picture.words.filter(text => /latency/.test(text)), []);
});

// Of each camera a shot of the player of its slot, from 0 on.
function timelineOf(cameras) {
    const timeline = new Timeline(kept);
    for (const id of cameras) timeline.addState(0, id, id, 2);
    return timeline;
}

const rowsOf = ({bars}) => [...new Set(bars.filter(({alpha}) => alpha === 0.65).map(({rectangle: [, y]}) => y))].sort((a, b) => a - b);

test('of the other cameras those are drawn that are there, and where there is no room for all it is said', () => {
    const gone = [100, 101, 102];
    const timeline = timelineOf([5, ...gone]);
    timeline.addFrame({t: 10, cameras: new Map([[5, {target: 5, flags: 2}]])});
    for (const id of [1, 2]) timeline.addState(20e3, id, id, 2);
    timeline.addLatency(0, 10);
    const few = viewOf();
    few.draw({timeline, first: 1000});
    assert.equal(rowsOf(few).length, 2);
    assert.equal(rowsOf(few)[1] - rowsOf(few)[0], 4, 'those that have left take no room');
    assert.deepEqual(few.words.filter(text => /cameras/.test(text)), []);

    const many = timelineOf(Array.from({length: 20}, (_, id) => id));
    many.addLatency(0, 10);
    for (const [clientHeight, rows] of [[70, 8], [58, 1]]) {
        const picture = viewOf({clientWidth: 360, clientHeight});
        picture.draw({timeline: many});
        assert.equal(rowsOf(picture).length, rows);
        assert.ok(picture.words.includes(`${19 - rows} of 19 other cameras are not drawn`), picture.words.join());
    }
});

test('the picture is drawn again only when something in it changes, while the cursor moves', () => {
    const {bars, cursor, element, draw, view} = viewOf();
    const timeline = timelineOf([5, 6]);
    let shown = {timeline};
    const isDrawn = more => {
        bars.length = 0;
        shown = {...shown, ...more};
        draw(shown);
        return bars.length > 0;
    };
    assert.ok(isDrawn());
    const {transform: before} = cursor.style;
    assert.ok(!isDrawn({t: 30e3}));
    assert.notEqual(cursor.style.transform, before);
    assert.ok(!isDrawn({last: 60040}), 'less than half a pixel');
    assert.ok(isDrawn({last: 60100}));
    for (const more of [{camera: 6}, {delayMs: 100}, {colourOfSlot: slot => `#00000${slot}`}, {first: 10e3}]) assert.ok(isDrawn(more), Object.keys(more)[0]);
    const changes = [() => timeline.addState(30e3, 6, 7, 2), () => timeline.addNote({kind: 'cut', camera: 5, t: 30e3}),
        () => timeline.addNote({kind: 'event', event: 'kill', t: 30e3, actor: 1}), () => timeline.addLatency(0, 10),
        () => timeline.addLatency(0, 20), () => { element.clientWidth = 500; }, () => { globalThis.devicePixelRatio = 2; }, () => view.clear()];
    for (const change of changes) {
        change();
        assert.ok(isDrawn(), `${change}`);
        assert.ok(!isDrawn(), `${change}`);
    }
});

test('a change between the states of a shot is seen as one', () => {
    const {bars, draw} = viewOf();
    for (const [target, flags] of [[1, null], [2, 2], [2, 4], [3, 4]]) {
        const timeline = timelineOf([5]);
        timeline.addState(20e3, 5, target, flags);
        timeline.addState(40e3, 5, 4, 2);
        bars.length = 0;
        draw({timeline});
        assert.ok(bars.length > 0, `${target} ${flags}`);
    }
});

test('what is cleared shows no cursor until something is drawn again', () => {
    const {cursor, draw, view} = viewOf();
    draw();
    assert.equal(cursor.hidden, false);
    view.clear();
    assert.equal(cursor.hidden, true);
    draw();
    assert.equal(cursor.hidden, false);
});
