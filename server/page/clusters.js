// Parts a set of points into clusters of at most so many that lie close together: lists of the points' numbers.
// `points`: three coordinates each.
export function clusters(points, most) {
    const found = [];
    const part = list => {
        if (list.length <= most) return void found.push(list);
        const axis = longestAxis(points, list);
        let sum = 0;
        for (const i of list) sum += points[3 * i + axis];
        const first = partition(list, i => points[3 * i + axis] * list.length < sum);
        // Points that all lie at one place are parted anywhere.
        const middle = first > 0 && first < list.length ? first : list.length >> 1;
        part(list.subarray(0, middle));
        part(list.subarray(middle));
    };
    if (points.length > 0) part(Uint32Array.from({length: points.length / 3}, (_, i) => i));
    return found;
}

function longestAxis(points, list) {
    const low = [Infinity, Infinity, Infinity];
    const high = [-Infinity, -Infinity, -Infinity];
    for (const i of list) {
        for (let axis = 0; axis < 3; ++axis) {
            low[axis] = Math.min(low[axis], points[3 * i + axis]);
            high[axis] = Math.max(high[axis], points[3 * i + axis]);
        }
    }
    const sizes = low.map((value, axis) => high[axis] - value);
    return sizes.indexOf(Math.max(...sizes));
}

// Moves what is to be first to the front; returns how many those are.
function partition(list, isFirst) {
    let first = 0;
    for (let i = 0; i < list.length; ++i) {
        if (!isFirst(list[i])) continue;
        [list[i], list[first]] = [list[first], list[i]];
        ++first;
    }
    return first;
}
