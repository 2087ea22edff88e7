import assert from 'node:assert/strict';
import {test} from 'node:test';
import {featureEdges} from '../../../server/page/glb.js';

// A square of two triangles in a plane, whose corners have these numbers, as the only ones that are used.
function square([a, b, c, d]) {
    const positions = new Float32Array(3 * (Math.max(a, b, c, d) + 1));
    [[a, 0, 0], [b, 1, 0], [c, 1, 1], [d, 0, 1]].forEach(([corner, x, y]) => positions.set([x, y, 0], 3 * corner));
    return {positions, indices: new Uint32Array([a, b, c, a, c, d])};
}

const pairsOf = edges => Array.from({length: edges.length / 2}, (_, i) => `${edges[2 * i]} ${edges[2 * i + 1]}`).sort();

test('the edges of a square are its sides, without what divides it, whatever the numbers of its corners', () => {
    for (const first of [0, 4e6]) {
        const [a, b, c, d] = [0, 1, 2, 3].map(i => first + i);
        assert.deepEqual(pairsOf(featureEdges(square([a, b, c, d]))), [`${a} ${b}`, `${a} ${d}`, `${b} ${c}`, `${c} ${d}`]);
    }
});
