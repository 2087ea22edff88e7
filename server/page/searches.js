// Searches: what is drawn of a camera that is on its way to a player whom it has lost. The way itself is not in the stream.
import {modeOf} from './timeline_view.js';

export const maxDashes = 64;
const marginPx = 26;  // of the mark from the edges of the picture

// The players of a sample whom cameras search for, by camera. `isOfGroup(camera)`: of a shot of several players the flag
// says that not all of them are shown.
export function searchesOf({cameras, players}, isOfGroup) {
    const searches = new Map();
    for (const [id, shot] of cameras)
        if (modeOf(shot) === 'searching' && !isOfGroup(id) && players.has(shot.target)) searches.set(id, players.get(shot.target));
    return searches;
}

// Dashes of about this length, as long as the gaps between them, the first from `from`, the last to `to`: of each two
// the parts of the way, 0 to 1, where it begins and ends.
export function dashesOf(from, to, length) {
    const distance = Math.hypot(...to.map((value, axis) => value - from[axis]));
    const count = Math.min(Math.max(Math.round((distance / length + 1) / 2), 1), maxDashes);
    const part = 1 / (2 * count - 1);
    return Array.from({length: count}, (_, i) => [2 * i * part, (2 * i + 1) * part]);
}

// A vector of the match as the camera has it: ahead, left, up.
function turnedBack([x, y, z], [qx, qy, qz, qw]) {
    const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    const axis = [-qx, -qy, -qz];
    const once = cross(axis, [x, y, z]);
    const twice = cross(axis, once);
    return [x, y, z].map((value, i) => value + 2 * (qw * once[i] + twice[i]));
}

// Where in a camera's picture of this size, in pixels from its top left corner, a place is, or at its edge the direction
// in which it is: {x, y, angle}, clockwise from the right in radians, null where the place is in the picture.
export function markOf({position, rotation, fov}, place, {width, height}) {
    const [ahead, left, up] = turnedBack(place.map((value, axis) => value - position[axis]), rotation);
    const halfWidth = Math.max(width / 2 - marginPx, 1);
    const halfHeight = Math.max(height / 2 - marginPx, 1);
    const scale = height / 2 / Math.tan(fov / 2) / ahead;
    const [right, down] = [-left * scale, -up * scale];
    if (ahead > 0 && Math.abs(right) <= halfWidth && Math.abs(down) <= halfHeight)
        return {x: width / 2 + right, y: height / 2 + down, angle: null};
    // Straight behind, down is as good as any.
    const [dx, dy] = left === 0 && up === 0 ? [0, 1] : [-left, -up];
    const toEdge = Math.min(halfWidth / Math.abs(dx), halfHeight / Math.abs(dy));
    return {x: width / 2 + dx * toEdge, y: height / 2 + dy * toEdge, angle: Math.atan2(dy, dx)};
}

// The mark over the picture through a camera.
export class SearchMark {
    constructor(element) {
        this.element = element;
    }

    hide() {
        this.element.toggleAttribute('hidden', true);
    }

    // `size`: of the picture, {width, height} in pixels.
    show(shot, player, colour, size) {
        const {x, y, angle} = markOf(shot, player.position, size);
        const {style, dataset} = this.element;
        style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px) rotate(${(angle ?? 0).toFixed(3)}rad)`;
        style.color = colour;
        dataset.place = angle === null ? 'inside' : 'edge';
        this.element.toggleAttribute('hidden', false);
    }
}
