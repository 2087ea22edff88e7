// What is asked of the server, with the token where it wants one.

const key = 'camera-director-token';
const silenceMs = 20e3;

// A link may carry `#token=...&match=...`: what follows # is never sent. The token leaves the address bar.
function takeFromAddress() {
    const given = new URLSearchParams(location.hash.slice(1));
    if (given.get('token')) {
        setToken(given.get('token'));
        given.delete('token');
        history.replaceState(null, '', `${location.pathname}${location.search}#${given}`);
    }
    matchOfAddress = given.get('match');
}

export let matchOfAddress = null;
takeFromAddress();

// `changed()`: another link of this page was opened in its place, which loads nothing anew.
export function followAddress(changed) {
    addEventListener('hashchange', () => {
        takeFromAddress();
        changed();
    });
}

// `?broadcast=URL`: a list of broadcasts, of a cache for example, is all that there is to watch.
export const broadcastOfAddress = new URLSearchParams(location.search).get('broadcast');

export function rememberMatch(matchId) {
    history.replaceState(null, '', `${location.pathname}${location.search}#${new URLSearchParams({match: matchId})}`);
}

export function token() {
    return sessionStorage.getItem(key);
}

// What is not of a token, spaces of any width that were copied with it, could not be sent.
export function setToken(value) {
    sessionStorage.setItem(key, value.replace(/[^\x21-\x7e]/g, ''));
}

// `abort`: an AbortSignal that ends it, or none. It ends by itself when nothing comes for some time. Only this page's own
// server is given the token.
export async function ask(path, abort) {
    const url = new URL(path, location.href);
    const given = url.origin === location.origin ? token() : null;
    const limit = new AbortController();
    let silence = 0;
    const expectMore = () => {
        clearTimeout(silence);
        silence = setTimeout(() => limit.abort(), silenceMs);
    };
    if (abort?.aborted) limit.abort();
    abort?.addEventListener('abort', () => limit.abort());
    expectMore();
    const answer = await fetch(url, {headers: given ? {Authorization: `Bearer ${given}`} : {}, signal: limit.signal});
    if (!answer.body || !globalThis.TransformStream) return answer;
    const content = answer.body.pipeThrough(new TransformStream({
        transform(part, to) {
            expectMore();
            to.enqueue(part);
        },
        flush: () => clearTimeout(silence),
    }));
    return new Response(content, answer);
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
