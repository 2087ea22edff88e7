import assert from 'node:assert/strict';
import {test} from 'node:test';
import {columnsOf, lateMs, latencyOf, latencyText, stepMs} from '../../../server/page/latency.js';

test('a latency is known where the clocks agree', () => {
    assert.equal(latencyOf(1000, 1040), 40);
    assert.equal(latencyOf(1000, 500), 0, 'a clock may be a little ahead');
    assert.equal(latencyOf(2000, 1000), null);
    assert.equal(latencyOf(0, 600e3), null);
    assert.equal(latencyOf(0, 1.7e12), null, 'there is no source time');
});

test('what is intended is no latency', () => {
    assert.equal(lateMs(10040, 10000), 40);
    assert.equal(lateMs(9990, 10000), 0);
    assert.equal(latencyText(10040.4, 10000), 'latency 40 ms');
});

test('a column has the greatest latency of its times, at whatever scale', () => {
    const latencies = [{t: 0, ms: 20}, {t: 250, ms: 45}, {t: 500, ms: 30}, {t: 2000, ms: 7}];
    assert.deepEqual([...columnsOf(latencies, 0, 2500, 5)], [45, 30, -1, -1, 7]);
    assert.deepEqual([...columnsOf(latencies, 0, 2000, 1)], [45]);
    assert.deepEqual([...columnsOf(latencies, 125, 625, 4)], [20, 45, 45, 30], 'one that began before is seen');
    assert.deepEqual([...columnsOf(latencies, 3000, 4000, 2)], [-1, -1]);
    // As the slow way has it, where nothing is closer than a column.
    const many = Array.from({length: 400}, (_, i) => ({t: i * stepMs, ms: i * 7919 % 1000}));
    const found = columnsOf(many, 0, 100e3, 100);
    for (let column = 0; column < 100; ++column)
        assert.equal(found[column], Math.max(...many.slice(4 * column, 4 * column + 4).map(({ms}) => ms)));
});
