// Sends the token once; the server sets it as a cookie that scripts cannot read.
'use strict';
const form = document.querySelector('form');
const said = document.querySelector('[role=alert]');
form.addEventListener('submit', async (event) => {
  event.preventDefault();
  said.textContent = '';
  try {
    const answer = await fetch('api/v1/session', {
      method: 'POST',
      headers: {'Content-Type': 'application/json'},
      body: JSON.stringify({token: document.getElementById('token').value.trim()}),
    });
    if (answer.ok) return location.assign('./' + location.hash);  // the requested page
    said.textContent = (await answer.json()).detail;
  } catch {
    said.textContent = 'the server does not answer';
  }
});
