// Clusters of points.
import assert from 'node:assert/strict';
import {test} from 'node:test';
import {clusters} from '../../../server/page/clusters.js';

// A number from 0 to 1, each time another.
function randomOf(seed) {
    let state = seed;
    return () => {
        state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
        return state / 2 ** 32;
    };
}

test('each point is in one cluster, none of which is too large', () => {
    for (let seed = 1; seed <= 50; ++seed) {
        const random = randomOf(seed);
        const count = Math.floor(random() * 500);
        const most = 1 + Math.floor(random() * 40);
        const places = 1 + Math.floor(random() * 20);  // many points at one place
        const points = Float32Array.from({length: 3 * count}, () => Math.floor(random() * places));
        const found = clusters(points, most);
        assert.ok(found.every(list => list.length > 0 && list.length <= most), `seed ${seed}`);
        assert.deepEqual(found.flatMap(list => [...list]).sort((a, b) => a - b), [...Array(count).keys()], `seed ${seed}`);
    }
});

test('what lies apart is not in one cluster', () => {
    const points = Float32Array.from([0, 0, 0, 90, 0, 0, 1, 0, 0, 91, 0, 0, 0, 1, 0, 90, 1, 0]);
    assert.deepEqual(clusters(points, 3).map(list => [...list].sort()), [[0, 2, 4], [1, 3, 5]]);
});
