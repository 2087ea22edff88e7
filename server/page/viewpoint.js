// The viewer's own viewpoints, from the side and from above, moved by pointer, touch and keys.
import {three} from './stage.js';

const minPitch = 0.05;
const maxPitch = Math.PI / 2 - 0.01;
const keyTurn = 0.12;
const keyShift = 0.06;  // of the view
const keyZoom = 1.2;

export class Viewpoint {
    constructor() {
        this.yaw = -2.2;
        this.pitch = 0.95;
        this.distance = this.span = 100;
        this.centre = new three.Vector3();
    }

    // All of the map, in a view of this shape (width / height).
    fit(bounds, shape) {
        const size = bounds.getSize(new three.Vector3());
        bounds.getCenter(this.centre);
        this.whole = size.length();
        this.distance = this.whole * 0.85;
        // Of the smaller side.
        this.span = 1.12 * (shape > 1 ? Math.max(size.y, size.x / shape) : Math.max(size.x, size.y * shape));
    }

    turn(dx, dy) {
        this.yaw -= dx;
        this.pitch = Math.min(Math.max(this.pitch + dy, minPitch), maxPitch);
    }

    // By parts of the view's height, to the right and up.
    shift(dx, dy, plan) {
        const scale = plan ? this.span : this.distance;
        const angle = plan ? Math.PI / 2 : this.yaw + Math.PI;
        const ahead = new three.Vector3(Math.cos(angle), Math.sin(angle), 0);
        const right = new three.Vector3(Math.sin(angle), -Math.cos(angle), 0);
        this.centre.addScaledVector(right, dx * scale).addScaledVector(ahead, dy * scale);
    }

    zoom(factor) {
        const whole = this.whole ?? 1e4;
        this.distance = Math.min(Math.max(this.distance * factor, whole / 50), whole * 3);
        this.span = Math.min(Math.max(this.span * factor, whole / 50), whole * 3);
    }

    // Returns whether the key means something here.
    key(event, plan) {
        const moves = plan || event.shiftKey;
        const [dx, dy] = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]}[event.key] ?? [0, 0];
        if (dx !== 0 || dy !== 0) {
            if (moves) this.shift(dx * keyShift, dy * keyShift, plan); else this.turn(-dx * keyTurn, dy * keyTurn);
        } else if (event.key === '+' || event.key === '=') this.zoom(1 / keyZoom);
        else if (event.key === '-') this.zoom(keyZoom);
        else return false;
        return true;
    }
}

// One pointer turns (in plan: moves), two pinch and move, the wheel zooms. `isPlan` and `changed` are asked and told.
export function attach(element, viewpoint, {active, isPlan, changed}) {
    const pointers = new Map();
    const middle = () => {
        const all = [...pointers.values()];
        return {x: all.reduce((sum, p) => sum + p.x, 0) / all.length, y: all.reduce((sum, p) => sum + p.y, 0) / all.length,
            spread: all.length > 1 ? Math.hypot(all[0].x - all[1].x, all[0].y - all[1].y) : 0};
    };
    element.addEventListener('pointerdown', event => {
        if (!active()) return;
        pointers.set(event.pointerId, {x: event.clientX, y: event.clientY});
        element.setPointerCapture(event.pointerId);
    });
    element.addEventListener('pointermove', event => {
        if (!pointers.has(event.pointerId)) return;
        const before = middle();
        pointers.set(event.pointerId, {x: event.clientX, y: event.clientY});
        const after = middle();
        const dx = (after.x - before.x) / element.clientHeight;
        const dy = (after.y - before.y) / element.clientHeight;
        if (isPlan() || pointers.size > 1 || event.buttons & 2 || event.shiftKey) viewpoint.shift(-dx, dy, isPlan());
        else viewpoint.turn(dx * 3.5, dy * 3.5);
        if (before.spread > 0 && after.spread > 0) viewpoint.zoom(before.spread / after.spread);
        changed();
    });
    for (const name of ['pointerup', 'pointercancel']) element.addEventListener(name, event => pointers.delete(event.pointerId));
    element.addEventListener('contextmenu', event => active() && event.preventDefault());
    element.addEventListener('wheel', event => {
        if (!active()) return;
        event.preventDefault();
        viewpoint.zoom(Math.exp(event.deltaY * 0.0012));
        changed();
    }, {passive: false});
}
