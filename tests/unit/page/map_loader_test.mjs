import assert from 'node:assert/strict';
import {test} from 'node:test';
import {MapLoader} from '../../../server/page/map_loader.js';

// What is done with the models that the server answers with, by `map/file`; a function is called.
function stageOf(answers) {
    const done = [];
    const clock = {ms: 0};
    const map = {clear: () => done.push('clear'), setObstacles: file => done.push(`obstacles ${file}`),
        setMesh: file => done.push(`mesh ${file}`)};
    const fetchModel = async (name, file) => {
        const answer = answers[`${name}/${file}`];
        return typeof answer === 'function' ? answer() : answer;
    };
    const loader = new MapLoader({map}, fetchModel, () => clock.ms,
        {contents: ({movers}) => done.push(`movers: ${movers}`), obstacles: has => done.push(`has obstacles: ${has}`), loaded: has => done.push(`loaded: ${has}`)});
    return {answers, clock, done, loader};
}

const contents = movers => ({file: new TextEncoder().encode(JSON.stringify({version: 1, fixed_cameras: [], movers})).buffer});
const whole = {'hall/contents.json': contents(['door']), 'hall/obstacles.glb': {file: 'o'}, 'hall/mesh.glb': {file: 'm'}};
const without = reason => ({file: null, reason});
const unreachable = () => Promise.reject(new TypeError('no network'));

test('a map is its obstacles, then its mesh, once', async () => {
    const {done, loader} = stageOf(whole);
    await loader.load('hall');
    assert.deepEqual(done.splice(0), ['clear', 'movers: ', 'movers: door', 'obstacles o', 'has obstacles: true', 'mesh m', 'loaded: true']);
    assert.equal(loader.note, '');
    await loader.load('hall');
    assert.deepEqual(done, [], 'it is shown already');
});

test('what is missing is said', async () => {
    const {answers, clock, done, loader} = stageOf({...whole, 'hall/obstacles.glb': without('no source')});
    await loader.load('hall');
    assert.deepEqual(done.splice(0), ['clear', 'movers: ', 'movers: door', 'has obstacles: false', 'mesh m', 'loaded: false']);
    assert.equal(loader.note, 'Only the free space of this map can be shown: no source.');
    assert.equal(loader.shown, 'hall');

    Object.assign(answers, {'other/contents.json': without('not loaded'), 'other/obstacles.glb': without('no source'), 'other/mesh.glb': without('not loaded')});
    await loader.load('other');
    assert.equal(loader.note, 'This map cannot be shown: not loaded.');
    assert.equal(loader.shown, null, 'it is asked for again');
    answers['other/mesh.glb'] = {file: 'm'};
    clock.ms = 3000;
    await loader.load('other');
    assert.equal(loader.shown, 'other');
});

test('a server that does not answer is asked after waits that grow to a minute', async () => {
    const {clock, done, loader} = stageOf({'hall/contents.json': unreachable});
    const times = [];
    for (; clock.ms < 400e3; clock.ms += 1000) {
        await loader.load('hall');
        if (done.splice(0).length > 0) times.push(clock.ms / 1000);
        assert.equal(loader.shown, null);
    }
    assert.deepEqual(times, [0, 3, 9, 21, 45, 93, 153, 213, 273, 333, 393]);
});

test('of a map that is no longer wanted nothing is shown', async () => {
    for (const late of ['contents.json', 'obstacles.glb', 'mesh.glb']) {
        let arrive;
        const {done, loader} = stageOf({...whole, [`hall/${late}`]: () => new Promise(resolve => { arrive = resolve; }),
            'other/contents.json': contents(['lift']), 'other/obstacles.glb': {file: 'o2'}, 'other/mesh.glb': {file: 'm2'}});
        const first = loader.load('hall');
        await new Promise(resolve => setImmediate(resolve));
        done.length = 0;
        await loader.load('other');
        arrive(late === 'contents.json' ? contents(['late']) : {file: 'late'});
        await first;
        assert.deepEqual(done, ['clear', 'movers: ', 'movers: lift', 'obstacles o2', 'has obstacles: true', 'mesh m2', 'loaded: true']);
        assert.equal(loader.shown, 'other');
    }
});
