import assert from 'node:assert/strict';
import {register} from 'node:module';
import {test} from 'node:test';

// three.js and the canvas are made up: of a text that is drawn its place is kept.
const three = 'data:text/javascript,export class CanvasTexture { dispose() {} }';
register(`data:text/javascript,${encodeURIComponent(`export const resolve = (specifier, context, next) =>
    specifier === './three.js' ? {url: ${JSON.stringify(three)}, shortCircuit: true} : next(specifier, context);`)}`);
globalThis.document = {createElement: () => ({
    getContext() {
        this.texts = new Map();
        return {measureText: text => ({width: 16 * text.length}), beginPath() {}, arc() {}, fill() {},
            fillText: (text, x, y) => this.texts.set(text, {x, y})};
    },
})};
const {NameSheet} = await import('../../../server/page/name_sheet.js');

const names = Array.from({length: 32}, (_, i) => ({key: i, text: `a long name, ${String(i).padStart(2, '0')}`, colour: '#fff'}));

test('each box is where its name stands, although the sheet grows as names are added', () => {
    const sheet = new NameSheet();
    const before = sheet.canvas.width;
    sheet.boxesOf(names.slice(0, 2)).forEach(box => assert.ok(box.every(part => part >= 0 && part <= 1)));
    const boxes = sheet.boxesOf(names);
    const {width: side, texts} = sheet.canvas;
    assert.ok(side > before);
    boxes.forEach(([x, y, width, height], i) => {
        const at = texts.get(names[i].text);
        assert.ok(at.x > x * side && at.x < (x + width) * side && at.y > y * side && at.y < (y + height) * side, names[i].text);
    });
});
