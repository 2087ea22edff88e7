import assert from 'node:assert/strict';
import {test} from 'node:test';
import {facesOf} from '../../../server/page/convex.js';

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

// Six times the volume within the faces, where they are closed and face outwards.
function sixVolumes(faces) {
    let sum = 0;
    for (const face of faces) for (let i = 2; i < face.length; ++i) sum += dot(face[0], cross(face[i - 1], face[i]));
    return sum;
}

const box = ([x, y, z], size) => [[1, 0, 0, x + size], [-1, 0, 0, size - x], [0, 1, 0, y + size], [0, -1, 0, size - y],
    [0, 0, 1, z + size], [0, 0, -1, size - z]];

test('a box has six faces of four corners, wherever it is', () => {
    for (const centre of [[0, 0, 0], [500, -3000, 20]]) {
        const faces = facesOf(box(centre, 8));
        assert.equal(faces.length, 6);
        for (const face of faces) {
            assert.equal(face.length, 4);
            for (const point of face) point.forEach((value, axis) => assert.ok(Math.abs(Math.abs(value - centre[axis]) - 8) < 1e-6, `${point}`));
        }
        assert.ok(Math.abs(sixVolumes(faces) - 6 * 16 ** 3) < 1e-3);
    }
});

test('half spaces that cut nothing off add nothing', () => {
    const faces = facesOf([...box([0, 0, 0], 1), [1, 0, 0, 5], [Math.SQRT1_2, Math.SQRT1_2, 0, 2]]);
    assert.equal(faces.length, 6);
    assert.ok(Math.abs(sixVolumes(faces) - 6 * 8) < 1e-6);
});

test('a half space through a corner leaves a closed surface', () => {
    const faces = facesOf([...box([0, 0, 0], 1), [1 / Math.sqrt(3), 1 / Math.sqrt(3), 1 / Math.sqrt(3), Math.sqrt(3)]]);
    assert.ok(Math.abs(sixVolumes(faces) - 6 * 8) < 1e-6);
});

test('a plane that is given twice, or nearly, has one face', () => {
    const [c, s] = [Math.cos(0.3), Math.sin(0.3)];
    const turned = box([0, 0, 0], 8).map(([x, y, z, d]) => [c * x - s * y, s * x + c * y, z, d]);
    for (const more of [turned[0], turned[0].map(Math.fround), [turned[0][0] * (1 + 1e-7), ...turned[0].slice(1)]]) {
        const faces = facesOf([...turned, more]);
        assert.equal(faces.length, 6);
        assert.ok(Math.abs(sixVolumes(faces) - 6 * 16 ** 3) < 0.1);
    }
    assert.equal(facesOf(box([900000, 0, 0], 8)).length, 6, 'far away');
});

test('random hulls are closed: as many faces and corners as edges and two', () => {
    let seed = 5;
    const random = () => (seed = seed * 48271 % 2147483647) / 2147483647 * 2 - 1;
    for (let i = 0; i < 200; ++i) {
        const planes = box([0, 0, 0], 10);
        while (planes.length < 6 + i % 30) {
            const [x, y, z] = [random(), random(), random()];
            const length = Math.hypot(x, y, z);
            planes.push([x / length, y / length, z / length, 4 + 4 * Math.abs(random())]);
        }
        const faces = facesOf(planes);
        const corners = new Set(faces.flat().map(point => point.map(value => value.toFixed(4)).join()));
        const edges = faces.reduce((sum, face) => sum + face.length, 0) / 2;
        assert.equal(faces.length + corners.size, edges + 2, `hull ${i}`);
        for (const point of faces.flat())
            for (const [x, y, z, distance] of planes) assert.ok(dot(point, [x, y, z]) <= distance + 1e-6);
    }
});
