// The lists of cameras and matches. Rows stay while their content changes, so that the focus stays too.
import {modeOf, modeText} from './timeline_view.js';

function element(tag, properties, ...children) {
    const made = Object.assign(document.createElement(tag), properties);
    made.append(...children);
    return made;
}

function setText(node, text) {
    if (node.textContent !== text) node.textContent = text;
}

function setAttribute(node, name, value) {
    if (node.getAttribute(name) !== String(value)) node.setAttribute(name, value);
}

export class Rows {
    constructor(list) {
        this.list = list;
        this.rows = new Map();
        this.empty = element('li', {className: 'empty'});
        list.append(this.empty);
    }

    // `entries`: [{key, number, colour, name, detail, mode, modeText, pressed, choose}], as they are to stand. `empty`: what is
    // said where there are none.
    show(entries, empty) {
        setText(this.empty, empty);
        this.empty.hidden = entries.length > 0;
        const keys = new Set(entries.map(entry => entry.key));
        for (const [key, row] of this.rows) {
            if (keys.has(key)) continue;
            row.item.remove();
            this.rows.delete(key);
        }
        entries.forEach((entry, i) => {
            const row = this.rowOf(entry.key);
            setText(row.number, entry.number);
            row.number.style.background = entry.colour;
            setText(row.name, entry.name);
            setText(row.detail, entry.detail ?? '');
            setText(row.mode, entry.modeText ?? '');
            setAttribute(row.mode, 'data-mode', entry.mode ?? '');
            setAttribute(row.button, 'aria-pressed', entry.pressed);
            row.button.onclick = entry.choose;
            this.place(row.item, i);
        });
    }

    // An item that is moved loses the focus: the others make room for one that has it.
    place(item, i) {
        const {children} = this.list;
        if (item.contains(document.activeElement)) while (children[i] !== item) this.list.append(children[i]);
        else if (children[i] !== item) this.list.insertBefore(item, children[i]);
    }

    rowOf(key) {
        let row = this.rows.get(key);
        if (row) return row;
        const number = element('span', {className: 'number', ariaHidden: 'true'});
        const name = element('span');
        const detail = element('small');
        const mode = element('span', {className: 'mode'});
        const button = element('button', {type: 'button'}, number, element('span', {className: 'name'}, name, detail), mode);
        button.dataset.key = key;
        row = {item: element('li', {}, button), button, number, name, detail, mode};
        this.rows.set(key, row);
        return row;
    }
}

export function shotEntry(camera, look, isOfGroup, profile, pressed, choose) {
    return {key: `camera ${camera.id}`, number: look.number, colour: look.colour, name: look.name, detail: profile,
        mode: modeOf(camera), modeText: modeText(camera, isOfGroup), pressed, choose};
}
