import assert from 'node:assert/strict';
import {test} from 'node:test';
import {Timeline} from '../../../server/page/timeline.js';
import {TimelineView} from '../../../server/page/timeline_view.js';

const kept = {keptMs: Infinity, maxStates: 4096, maxMarks: 1024};

// What is drawn of a timeline of a minute, 600 pixels wide: [{rectangle: [x, y, width, height], style}] and words.
function drawn(timeline, delayMs) {
    globalThis.devicePixelRatio = 1;
    const bars = [];
    const words = [];
    const context = {setTransform() {}, clearRect() {}, beginPath() {}, moveTo() {}, lineTo() {}, fill() {},
        measureText: text => ({width: 5 * text.length}), fillText: text => words.push(text),
        fillRect(...rectangle) { bars.push({rectangle, style: this.fillStyle}); }};
    const canvas = {getContext: () => context};
    const view = new TimelineView({querySelector: () => canvas, clientWidth: 600, clientHeight: 70});
    view.draw({timeline, camera: 5, t: 0, first: 0, last: 60e3, whole: true, delayMs, colourOfSlot: () => '#000000'});
    return {bars, words};
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
