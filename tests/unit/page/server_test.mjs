// What the page takes from its address, in a browser of which only that is made up.
import assert from 'node:assert/strict';
import {test} from 'node:test';

const kept = new Map();
const page = new EventTarget();
globalThis.sessionStorage = {getItem: key => kept.get(key) ?? null, setItem: (key, value) => kept.set(key, value)};
globalThis.location = {hash: '#match=cup', pathname: '/', search: ''};
globalThis.history = {replaceState(state, title, url) { location.hash = url.slice(url.indexOf('#')); }};
globalThis.addEventListener = (...listener) => page.addEventListener(...listener);
const server = await import('../../../server/page/server.js');

function open(hash) {
    location.hash = hash;
    page.dispatchEvent(new Event('hashchange'));
}

test('a link says which match is wanted', () => {
    assert.equal(server.matchOfAddress, 'cup');
    assert.equal(server.token(), null);
});

test('a link that is opened in the same tab is taken too, and its token leaves the address', () => {
    let changes = 0;
    server.followAddress(() => { ++changes; });
    open('#token=a%2Fb%2Bc&match=final');
    assert.equal(server.token(), 'a/b+c');
    assert.equal(server.matchOfAddress, 'final');
    assert.equal(location.hash, '#match=final');
    assert.equal(changes, 1);
});
