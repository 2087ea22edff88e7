import assert from 'node:assert/strict';
import {test} from 'node:test';
import {Rows} from '../../../server/page/lists.js';

// What of the browser's elements the lists use: one that is moved or removed loses the focus.
class Element {
    constructor(tag) {
        Object.assign(this, {tag, children: [], parent: null, style: {}, dataset: {}, attributes: new Map()});
    }

    append(...more) {
        for (const child of more) this.insertBefore(child, null);
    }

    insertBefore(child, before) {
        if (typeof child === 'string') return;
        child.remove();
        const at = before ? this.children.indexOf(before) : this.children.length;
        this.children.splice(at, 0, child);
        child.parent = this;
    }

    remove() {
        if (this.contains(document.activeElement)) document.activeElement = null;
        if (this.parent) this.parent.children.splice(this.parent.children.indexOf(this), 1);
        this.parent = null;
    }

    contains(element) {
        return element === this || this.children.some(child => child.contains(element));
    }

    setAttribute(name, value) { this.attributes.set(name, String(value)); }
    getAttribute(name) { return this.attributes.get(name) ?? null; }
}

globalThis.document = {createElement: tag => new Element(tag), activeElement: null};

const entriesOf = keys => [...keys].map(key => ({key, number: '1', colour: '#fff', name: key, pressed: false, choose() {}}));
const shownIn = list => list.children.filter(({className}) => className !== 'empty').map(({children: [button]}) => button.dataset.key).join('');

test('the row that has the focus keeps it, however the rows are ordered', () => {
    for (const focused of 'abcd') {
        const list = new Element('ul');
        const rows = new Rows(list);
        rows.show(entriesOf('abcd'));
        document.activeElement = rows.rows.get(focused).button;
        for (const order of ['dcba', 'cxadb', 'abcd', 'bdac', 'dcab', 'yabxcd', focused, 'abcd']) {
            rows.show(entriesOf(order));
            assert.equal(shownIn(list), order);
            assert.equal(document.activeElement, rows.rows.get(focused).button, `${focused} in ${order}`);
        }
    }
});

test('a row that is gone takes the focus along', () => {
    const list = new Element('ul');
    const rows = new Rows(list);
    rows.show(entriesOf('ab'));
    document.activeElement = rows.rows.get('a').button;
    rows.show(entriesOf('b'));
    assert.equal(document.activeElement, null);
    assert.equal(shownIn(list), 'b');
});
