import assert from 'node:assert/strict';
import {test} from 'node:test';
import {attachScrubbing} from '../../../server/page/scrubbing.js';

// A timeline of 100 pixels for 100 s, on which events are sent; `sought`: where the match was moved to.
function timeline({shown = 50e3} = {}) {
    const element = Object.assign(new EventTarget(), {setPointerCapture() {}, getBoundingClientRect: () => ({left: 0, width: 100})});
    const sought = [];
    attachScrubbing(element, {style: {}}, {range: () => [0, 100e3], axis: () => 'axis', now: () => shown, timeAt: x => x * 1000,
        describe: () => '', seek: t => sought.push(t), goToBegin: () => sought.push('begin'), goLive: () => sought.push('live')});
    const send = (type, properties) => element.dispatchEvent(Object.assign(new Event(type), properties));
    return {send, sought};
}

test('a press moves to a time, and dragging moves on until it is let go', () => {
    for (const end of ['pointerup', 'pointercancel']) {
        const {send, sought} = timeline();
        send('pointerdown', {button: 0, buttons: 1, clientX: 10});
        send('pointermove', {buttons: 1, clientX: 20});
        send(end, {button: 0, buttons: 0, clientX: 20});
        send('pointermove', {buttons: 1, clientX: 30});
        assert.deepEqual(sought, [10e3, 20e3], 'the last one was pressed elsewhere');
    }
});

test('other buttons do nothing', () => {
    const {send, sought} = timeline();
    send('pointerdown', {button: 2, buttons: 2, clientX: 10});
    send('pointermove', {buttons: 3, clientX: 20});
    assert.deepEqual(sought, []);
});

test('keys that move from the time that is shown do nothing while there is none', () => {
    const known = timeline();
    known.send('keydown', {key: 'ArrowLeft'});
    assert.deepEqual(known.sought, [49e3]);
    const unknown = timeline({shown: null});
    for (const key of ['ArrowLeft', 'PageUp', 'Home', 'End']) unknown.send('keydown', {key});
    assert.deepEqual(unknown.sought, ['begin', 'live']);
});
