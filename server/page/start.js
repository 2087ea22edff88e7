// Says why nothing is drawn where the page's modules cannot be loaded or run. No module itself, and for old browsers too.
(function () {
    function tell(reason) {
        document.getElementById('message').hidden = false;
        document.getElementById('message-text').textContent = 'This page cannot run: ' + reason + '.';
    }
    if (!('noModule' in document.createElement('script'))) tell('this browser is too old');
    window.addEventListener('error', function (event) {
        if (window.cameraDirector) return;
        if (event.target.tagName === 'SCRIPT') tell('a file of it or three.js is missing. The server\'s log says what to install');
        else if (event.message) tell(event.message);
    }, true);
})();
