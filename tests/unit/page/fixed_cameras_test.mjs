import assert from 'node:assert/strict';
import {test} from 'node:test';
import {nameOfFixed} from '../../../server/page/fixed_cameras.js';

test('a fixed camera is known by its place, which the stream has rounded', () => {
    const all = [{position: [1, 2, 3], spawn_point: 4}, {position: [100, 2, 3], spawn_point: null}];
    assert.equal(nameOfFixed(all, [1.04, 1.96, 3]), 'fixed camera 0, near spawn point 4');
    assert.equal(nameOfFixed(all, [100, 2, 3]), 'fixed camera 1');
    assert.equal(nameOfFixed(all, [50, 2, 3]), 'fixed camera');
    assert.equal(nameOfFixed(all, undefined), 'fixed camera', 'as in the history');
    assert.equal(nameOfFixed([], [1, 2, 3]), 'fixed camera', 'before the map is there');
});
