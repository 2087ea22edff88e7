import assert from 'node:assert/strict';
import {test} from 'node:test';
import {MapLoader} from '../../../server/page/map_loader.js';

// What is done with the models that the server answers with, by `map/file`; a function is called. The file 'broken' cannot
// be read.
function stageOf(answers) {
    const done = [];
    const asked = [];
    const clock = {ms: 0};
    const read = (what, file) => {
        if (file === 'broken') throw new Error('no glTF');
        done.push(`${what} ${file}`);
    };
    const map = {clear: () => done.push('clear'), setObstacles: file => read('obstacles', file), setMesh: file => read('mesh', file)};
    const fetchModel = async (name, file) => {
        asked.push(`${name}/${file}`);
        const answer = answers[`${name}/${file}`];
        return typeof answer === 'function' ? answer() : answer;
    };
    const loader = new MapLoader({map}, fetchModel, () => clock.ms,
        {contents: ({movers}) => done.push(`movers: ${movers.map(({name}) => name)}`), obstacles: has => done.push(`has obstacles: ${has}`), loaded: has => done.push(`loaded: ${has}`)});
    return {answers, asked, clock, done, loader};
}

const json = content => ({file: new TextEncoder().encode(JSON.stringify(content)).buffer});
const contents = names => json({version: 1, fixed_cameras: [], movers: names.map(name => ({name, kind: '', hulls: [], balls: []}))});
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
    const {asked, clock, loader} = stageOf({'hall/contents.json': unreachable});
    const times = [];
    for (; clock.ms < 400e3; clock.ms += 1000) {
        await loader.load('hall');
        if (asked.splice(0).length > 0) times.push(clock.ms / 1000);
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

test('a map that is wanted again while its first load waits is loaded once', async () => {
    for (const late of ['contents.json', 'obstacles.glb', 'mesh.glb']) {
        const waiting = [];
        const {answers, done, loader} = stageOf({...whole, [`hall/${late}`]: () => new Promise(resolve => waiting.push(resolve)),
            'other/contents.json': () => new Promise(() => {})});
        const first = loader.load('hall');
        await new Promise(resolve => setImmediate(resolve));
        loader.load('other');
        answers[`hall/${late}`] = whole[`hall/${late}`];
        done.length = 0;
        await loader.load('hall');
        waiting.forEach(resolve => resolve(whole[`hall/${late}`]));
        await first;
        assert.deepEqual(done, ['clear', 'movers: ', 'movers: door', 'obstacles o', 'has obstacles: true', 'mesh m', 'loaded: true'], late);
    }
});

test('after a lost request only what is missing is asked for again, and what is shown stays', async () => {
    const {answers, asked, clock, done, loader} = stageOf({...whole, 'hall/mesh.glb': unreachable});
    await loader.load('hall');
    assert.deepEqual(done.splice(0), ['clear', 'movers: ', 'movers: door', 'obstacles o', 'has obstacles: true']);
    assert.equal(loader.shown, null);
    asked.length = 0;
    answers['hall/mesh.glb'] = whole['hall/mesh.glb'];
    clock.ms = 3000;
    await loader.load('hall');
    assert.deepEqual(asked, ['hall/mesh.glb']);
    assert.deepEqual(done, ['mesh m', 'loaded: true']);
    assert.equal(loader.shown, 'hall');
});

test('a model that cannot be read is said to be missing', async () => {
    const {done, loader} = stageOf({...whole, 'hall/mesh.glb': {file: 'broken'}});
    await loader.load('hall');
    assert.deepEqual(done.slice(-2), ['has obstacles: true', 'loaded: true']);
    assert.equal(loader.note, 'The free space of this map cannot be shown: mesh.glb cannot be read.');

    const other = stageOf({...whole, 'hall/obstacles.glb': {file: 'broken'}});
    await other.loader.load('hall');
    assert.deepEqual(other.done.slice(-3), ['has obstacles: false', 'mesh m', 'loaded: false']);
    assert.equal(other.loader.note, 'Only the free space of this map can be shown: obstacles.glb cannot be read.');
});

test('the note of one map is not that of the next', async () => {
    const {loader} = stageOf({...whole, 'hall/obstacles.glb': without('no source'), 'other/contents.json': () => new Promise(() => {})});
    await loader.load('hall');
    assert.notEqual(loader.note, '');
    loader.load('other');
    assert.equal(loader.note, '');
});

test('contents that are not as they should be are none', async () => {
    const mover = {name: 'door', kind: '', hulls: [[[0, 0, 1, 8]]], balls: [[0, 0, 0, 1]]};
    const camera = {position: [1, 2, 3], yaw: 0, pitch: 0, spawn_point: null};
    const good = {version: 1, fixed_cameras: [camera], movers: [mover]};
    for (const bad of [{}, null, [], {...good, version: 2}, {...good, movers: undefined}, {...good, fixed_cameras: {}},
        {...good, fixed_cameras: [{...camera, position: [1, 2]}]}, {...good, movers: [null]}, {...good, movers: [{...mover, hulls: [[[0, 0, 1]]]}]},
        {...good, movers: [{...mover, balls: [[0, 0, 0, null]]}]}]) {
        const {done, loader} = stageOf({...whole, 'hall/contents.json': json(bad)});
        await loader.load('hall');
        assert.deepEqual(done.slice(0, 4), ['clear', 'movers: ', 'movers: ', 'obstacles o'], JSON.stringify(bad));
    }
    const {done, loader} = stageOf({...whole, 'hall/contents.json': json(good)});
    await loader.load('hall');
    assert.equal(done[2], 'movers: door');
});
