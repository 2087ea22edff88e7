import assert from 'node:assert/strict';
import {test} from 'node:test';
import {FragmentIndex, slackMs} from '../../../server/page/fragment_index.js';

// Fragments of 3 s and a little more, some of them with a long silence behind.
function fragments(count, random) {
    const all = [];
    for (let n = 0, from = 0; n < count; ++n, from = all[n - 1].to + (random() % 10 === 0 ? random() % 90e3 : 17))
        all.push({n, from, to: from + 2500 + random() % 550});
    return all;
}

// Reads until the answer stays, as Playback does.
function find(all, t, first, last) {
    const index = new FragmentIndex(3000);
    for (const {n, from} of [all[first], all[last]]) index.add(n, from);
    for (let reads = 1, n = index.locate(t, first, last); ; ++reads) {
        assert.ok(n >= first && n <= last);
        index.add(n, all[n].from, all[n].to);
        const next = index.locate(t, first, last);
        if (next === n) return {n, reads};
        n = next;
        assert.ok(reads < 100, 'it comes to an end');
    }
}

test('every time is found, or what follows it, in few steps', () => {
    let seed = 11;
    const random = () => (seed = seed * 48271 % 2147483647);
    let most = 0;
    for (let round = 0; round < 20; ++round) {
        const all = fragments(500, random);
        for (let i = 0; i < 50; ++i) {
            const t = random() % all[499].to;
            const {n, reads} = find(all, t, 0, 499);
            most = Math.max(most, reads);
            const wanted = all.find(({to}) => t <= to + slackMs);
            assert.ok(n === wanted.n || (t >= all[n].from && t <= all[n].to + slackMs), `${t}: ${n}, not ${wanted.n}`);
        }
    }
    assert.ok(most < 16, `${most} reads`);
});

test('what is before the first or behind the last is nearest to them', () => {
    const index = new FragmentIndex(3000);
    index.add(5, 15000, 17900);
    assert.equal(index.locate(-1e9, 3, 9), 3);
    assert.equal(index.locate(1e9, 3, 9), 9);
    assert.equal(index.locate(16000, 3, 9), 5);
    assert.equal(index.locate(16000, 7, 9), 7, 'it has been removed');
    assert.equal(index.beginOf(7), 21000);
    assert.equal(index.endOf(5), 17900);
    assert.equal(index.endOf(6), 21000);
});
