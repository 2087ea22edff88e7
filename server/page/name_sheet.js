// Names as they stand over the players, all on one texture.
import * as three from './three.js';

const height = 42;  // pixels of the sheet, for each name
const gap = 4;
const inset = 15;
const maxTextWidth = 420;
const smallestSide = 512;

export class NameSheet {
    constructor() {
        this.canvas = document.createElement('canvas');
        this.texture = new three.CanvasTexture(this.canvas);
        this.texture.flipY = false;
        this.clear();
    }

    clear() {
        this.names = new Map();  // by key: {text, colour, x, y, width}
        this.begin(smallestSide);
    }

    begin(side) {
        this.canvas.width = this.canvas.height = side;
        this.context = this.canvas.getContext('2d');
        this.context.font = '600 28px system-ui, sans-serif';
        this.context.textBaseline = 'middle';
        this.x = this.y = 0;
        this.texture.dispose();  // its size is another
    }

    // Where these names are, {key, text, colour}: x, y, width and height, in parts of the sheet, which may grow with each.
    boxesOf(names) {
        for (const name of names) this.add(name);
        const side = this.canvas.width;
        return names.map(({key}) => {
            const {x, y, width} = this.names.get(key);
            return [x / side, y / side, width / side, height / side];
        });
    }

    add({key, text, colour}) {
        if (this.names.has(key)) return;
        const name = {text, colour};
        this.names.set(key, name);
        if (!this.draw(name)) this.enlarge();
        this.texture.needsUpdate = true;
    }

    enlarge() {
        this.begin(2 * this.canvas.width);
        for (const name of this.names.values()) this.draw(name);
    }

    // Returns whether there was room.
    draw(name) {
        const c = this.context;
        const {width: side} = this.canvas;
        const textWidth = Math.min(Math.ceil(c.measureText(name.text).width), maxTextWidth);
        const width = textWidth + 2 * inset;
        if (this.x + width > side) {
            this.x = 0;
            this.y += height + gap;
        }
        if (this.y + height > side) return false;
        Object.assign(name, {x: this.x, y: this.y, width});
        this.x += width + gap;
        const radius = height / 2;
        c.fillStyle = 'rgba(9, 12, 16, 0.72)';
        c.beginPath();
        c.arc(name.x + radius, name.y + radius, radius, Math.PI / 2, Math.PI * 3 / 2);
        c.arc(name.x + width - radius, name.y + radius, radius, -Math.PI / 2, Math.PI / 2);
        c.fill();
        c.fillStyle = name.colour;
        c.fillText(name.text, name.x + inset, name.y + radius + 1, textWidth);
        return true;
    }
}
