import assert from 'node:assert/strict';
import {test} from 'node:test';
import {cameraFlag} from '../../../server/page/protocol.js';
import {SearchMark, dashesOf, markOf, maxDashes, searchesOf} from '../../../server/page/searches.js';

const right = Math.SQRT1_2;
const size = {width: 800, height: 600};
// At the origin, looks along x; half of the picture's height is as far as what is seen is ahead.
const shot = {id: 5, target: 1, flags: cameraFlag.searching, position: [0, 0, 0], rotation: [0, 0, 0, 1], fov: Math.PI / 2};
const player = {slot: 1, position: [10, 0, 0]};
const near = (found, wanted) => {
    for (const key of ['x', 'y']) assert.ok(Math.abs(found[key] - wanted[key]) < 1e-6, `${key}: ${found[key]} is not ${wanted[key]}`);
    if (wanted.angle === null) assert.equal(found.angle, null);
    else assert.ok(found.angle !== null && Math.cos(found.angle - wanted.angle) > 1 - 1e-9, `angle: ${found.angle} is not ${wanted.angle}`);
};

test('only a camera that searches has a player whom it searches for', () => {
    const players = new Map([[1, player]]);
    const of = (more, isOfGroup = () => false) => searchesOf({cameras: new Map([[5, {...shot, ...more}]]), players}, isOfGroup);
    assert.deepEqual([...of({})], [[5, player]]);
    assert.equal(of({flags: cameraFlag.visible}).size, 0);
    assert.equal(of({flags: cameraFlag.searching | cameraFlag.absent}).size, 0);
    assert.equal(of({target: 2}).size, 0, 'it is not known where the player is');
    assert.equal(of({target: null}).size, 0);
    assert.equal(of({}, id => id === 5).size, 0, 'of a group not all are shown');
    assert.equal(of({}, id => id === 6).size, 1);
});

test('dashes reach from one end to the other, and are bounded', () => {
    assert.deepEqual(dashesOf([0, 0, 0], [5, 0, 0], 1), [[0, 0.2], [0.4, 0.6000000000000001], [0.8, 1]]);
    for (const distance of [0, 0.3, 1, 7.7, 60, 1e6]) {
        const dashes = dashesOf([1, 2, 3], [1, 2 + distance, 3], 1);
        assert.ok(dashes.length >= 1 && dashes.length <= maxDashes, `${dashes.length} at ${distance}`);
        assert.equal(dashes[0][0], 0);
        assert.ok(Math.abs(dashes[dashes.length - 1][1] - 1) < 1e-9);
        const length = distance * dashes[0][1];
        if (distance >= 1 && distance < 100) assert.ok(length > 0.6 && length < 1.5, `${length} at ${distance}`);
    }
});

test('a player in the picture is marked there', () => {
    near(markOf(shot, [10, 0, 0], size), {x: 400, y: 300, angle: null});
    near(markOf(shot, [10, 5, 0], size), {x: 250, y: 300, angle: null});
    near(markOf(shot, [10, 0, 5], size), {x: 400, y: 150, angle: null});
    // A camera that is elsewhere and turned to the left: y is ahead of it, -x to its left.
    const turned = {...shot, position: [100, 100, 100], rotation: [0, 0, right, right]};
    near(markOf(turned, [100, 110, 100], size), {x: 400, y: 300, angle: null});
    near(markOf(turned, [95, 110, 100], size), {x: 250, y: 300, angle: null});
});

test('one who is not in it is pointed to from its edge', () => {
    near(markOf(shot, [1, -10, 0], size), {x: 774, y: 300, angle: 0});
    near(markOf(shot, [1, 10, 0], size), {x: 26, y: 300, angle: Math.PI});
    near(markOf(shot, [1, 0, 10], size), {x: 400, y: 26, angle: -Math.PI / 2});
    near(markOf(shot, [1, 0, -10], size), {x: 400, y: 574, angle: Math.PI / 2});
    near(markOf(shot, [-10, -1, 0], size), {x: 774, y: 300, angle: 0}, 'behind, to the right');
    near(markOf(shot, [0, -5, 0], size), {x: 774, y: 300, angle: 0}, 'beside');
    near(markOf(shot, [-10, 0, 0], size), {x: 400, y: 574, angle: Math.PI / 2}, 'straight behind');
    near(markOf(shot, [0, 0, 0], size), {x: 400, y: 574, angle: Math.PI / 2});
    near(markOf(shot, [1, -10, 10], size), {x: 674, y: 26, angle: -Math.PI / 4});
});

// The slow way: through the camera's three axes.
test('it is where the projection has it, whatever the camera does', () => {
    let seed = 7;
    const random = () => (seed = seed * 48271 % 2147483647) / 2147483647 * 2 - 1;
    for (let i = 0; i < 2000; ++i) {
        const q = [random(), random(), random(), random()];
        const length = Math.hypot(...q);
        const [x, y, z, w] = q.map(value => value / length);
        const axes = [[1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)],
            [2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)],
            [2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)]];
        const position = [random(), random(), random()];
        const place = [5 * random(), 5 * random(), 5 * random()];
        const [ahead, left, up] = axes.map(axis => axis.reduce((sum, value, k) => sum + value * (place[k] - position[k]), 0));
        const found = markOf({position, rotation: [x, y, z, w], fov: Math.PI / 2}, place, size);
        const wanted = [400 - 300 * left / ahead, 300 - 300 * up / ahead];
        const isInside = ahead > 0 && wanted[0] >= 26 && wanted[0] <= 774 && wanted[1] >= 26 && wanted[1] <= 574;
        if (isInside) near(found, {x: wanted[0], y: wanted[1], angle: null});
        else {
            assert.ok(Math.abs(Math.abs(found.x - 400) - 374) < 1e-6 || Math.abs(Math.abs(found.y - 300) - 274) < 1e-6, 'at the edge');
            assert.ok(Math.cos(found.angle - Math.atan2(-up, -left)) > 1 - 1e-9, 'towards the player');
        }
    }
});

test('a picture too small for the margin has its mark about the middle', () =>
    near(markOf(shot, [1, -10, 0], {width: 40, height: 40}), {x: 21, y: 20, angle: 0}));

test('the mark is placed, turned and hidden', () => {
    const element = {style: {}, dataset: {}, toggleAttribute(name, set) { this[name] = set; }};
    const mark = new SearchMark(element);
    mark.show(shot, {position: [1, 0, -10]}, '#56b4e9', size);
    assert.equal(element.style.transform, 'translate(400.0px, 574.0px) rotate(1.571rad)');
    assert.equal(element.style.color, '#56b4e9');
    assert.equal(element.dataset.place, 'edge');
    assert.equal(element.hidden, false);
    mark.show(shot, player, '#56b4e9', size);
    assert.equal(element.style.transform, 'translate(400.0px, 300.0px) rotate(0.000rad)');
    assert.equal(element.dataset.place, 'inside');
    mark.hide();
    assert.equal(element.hidden, true);
});
