// What is asked of the server, with the token where it wants one.

const key = 'camera-director-token';
const limitMs = 20e3;

// A link may carry `#token=...&match=...`: what follows # is never sent. The token leaves the address bar.
function takeFromAddress() {
    const given = new URLSearchParams(location.hash.slice(1));
    const token = given.get('token');
    if (token) {
        sessionStorage.setItem(key, token);
        given.delete('token');
        history.replaceState(null, '', `${location.pathname}${location.search}#${given}`);
    }
    return given.get('match');
}

export const matchOfAddress = takeFromAddress();

// `?broadcast=URL`: a list of broadcasts, of a cache for example, is all that there is to watch.
export const broadcastOfAddress = new URLSearchParams(location.search).get('broadcast');

export function rememberMatch(matchId) {
    history.replaceState(null, '', `${location.pathname}${location.search}#${new URLSearchParams({match: matchId})}`);
}

export function token() {
    return sessionStorage.getItem(key);
}

export function setToken(value) {
    sessionStorage.setItem(key, value);
}

// `abort`: an AbortSignal that ends it, or none. Only this page's own server is given the token.
export function ask(path, abort) {
    const url = new URL(path, location.href);
    const given = url.origin === location.origin ? token() : null;
    const limit = new AbortController();
    setTimeout(() => limit.abort(), limitMs);
    if (abort?.aborted) limit.abort();
    abort?.addEventListener('abort', () => limit.abort());
    return fetch(url, {headers: given ? {Authorization: `Bearer ${given}`} : {}, signal: limit.signal});
}

// The map's picture; null with a reason where there is none.
export async function model(map, file) {
    for (let attempt = 0; attempt < 30; ++attempt) {
        const answer = await ask(`/map/${encodeURIComponent(map)}/${file}`);
        if (answer.ok) return {file: await answer.arrayBuffer()};
        if (answer.status !== 503) {
            const isText = answer.headers.get('Content-Type')?.startsWith('text/plain');
            return {file: null, reason: isText ? (await answer.text()).trim() : `the server answers with ${answer.status}`};
        }
        await new Promise(resolve => setTimeout(resolve, 1000));
    }
    return {file: null, reason: 'the server is busy'};
}
