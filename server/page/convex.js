// The surface of a convex hull that is given by its half spaces, as those of movers are.

const far = 4e6;            // map units: hulls are within a quarter of it
const parallel = 1 - 1e-9;  // cosine

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

function normalised(v) {
    const length = Math.hypot(...v);
    return v.map(value => value / length);
}

// A large square in a plane, counterclockwise seen from outside.
function square([x, y, z, distance]) {
    const normal = [x, y, z];
    const across = normalised(cross(normal, Math.abs(z) < 0.7 ? [0, 0, 1] : [1, 0, 0]));
    const up = cross(normal, across);
    return [[1, 1], [-1, 1], [-1, -1], [1, -1]].map(([a, u]) => normal.map((n, axis) => n * distance + far * (a * across[axis] + u * up[axis])));
}

// Without those that are parallel to one that cuts off as much: each would take the other's face away.
function distinct(halfSpaces) {
    const isBehind = (a, i) => halfSpaces.some((b, j) => j !== i && dot(a, b) > parallel && (b[3] < a[3] || b[3] === a[3] && j < i));
    return halfSpaces.filter((plane, i) => !isBehind(plane, i));
}

// What of a polygon is in a half space.
function clipped(polygon, [x, y, z, distance]) {
    const heights = polygon.map(point => dot(point, [x, y, z]) - distance);
    return polygon.flatMap((point, i) => {
        const next = (i + 1) % polygon.length;
        const kept = heights[i] <= 0 ? [point] : [];
        if (heights[i] < 0 === heights[next] < 0 || heights[i] === 0 || heights[next] === 0) return kept;
        const part = heights[i] / (heights[i] - heights[next]);
        return [...kept, point.map((value, axis) => value + part * (polygon[next][axis] - value))];
    });
}

// The faces as polygons [[x, y, z], ...], counterclockwise seen from outside, without those of no extent. `halfSpaces`:
// [x, y, z, distance], the points whose product with the unit vector is at most the distance.
export function facesOf(halfSpaces) {
    return distinct(halfSpaces).map((plane, i, all) => all.reduce(
        (polygon, other, j) => i === j ? polygon : clipped(polygon, other), square(plane))).filter(polygon => polygon.length > 2);
}
