// Starts the real server on a free port; clients for requests, Server-Sent Events and WebSockets, with Node's
// own modules only.
import {spawn} from 'node:child_process';
import {randomBytes} from 'node:crypto';
import http from 'node:http';

export function startServer(binary, args) {
  const child = spawn(binary, ['serve', '--listen', '127.0.0.1:0', ...args]);
  let log = '';
  child.stderr.on('data', (text) => { log += text; });
  return new Promise((resolve, reject) => {
    let out = '';
    child.stdout.on('data', (text) => {
      out += text;
      const port = /dashboard: http:\/\/127\.0\.0\.1:(\d+)\//.exec(out)?.[1];
      if (port) resolve({port: Number(port), end: () => child.kill('SIGTERM'), log: () => log});
    });
    child.on('error', reject);
    child.on('exit', (code) => reject(new Error(`the server ended with ${code}: ${log}`)));
  });
}

// Resolves to {status, headers, text}. With `bodyless` only the header is sent, because the server may refuse
// it.
export function ask(port, method, path, {body, headers = {}, bodyless = false, agent = false} = {}) {
  return new Promise((resolve, reject) => {
    const request = http.request({port, host: '127.0.0.1', method, path, headers, agent, timeout: 60_000});
    request.on('response', (response) => {
      const chunks = [];
      response.on('data', (chunk) => chunks.push(chunk));
      response.on('end', () => resolve({status: response.statusCode, headers: response.headers,
                                        text: Buffer.concat(chunks).toString('utf8')}));
      response.on('error', reject);
    });
    request.on('upgrade', (response, socket) => {
      socket.destroy();
      resolve({status: response.statusCode, headers: response.headers, text: ''});
    });
    request.on('timeout', () => request.destroy(new Error(`no answer to ${method} ${path}`)));
    request.on('error', reject);
    if (bodyless) request.flushHeaders();
    else request.end(body);
  });
}

export const handshake = () => ({Connection: 'Upgrade', Upgrade: 'websocket', 'Sec-WebSocket-Version': '13',
                                 'Sec-WebSocket-Key': randomBytes(16).toString('base64')});

// Calls onMessage(parsed) for each text message. Server frames are whole and unmasked.
export function openWebSocket(port, path, onMessage) {
  return new Promise((resolve, reject) => {
    const request = http.request({port, host: '127.0.0.1', path, headers: handshake(), agent: false});
    request.on('upgrade', (response, socket, first) => {
      let pending = first;
      const take = () => {
        for (;;) {
          if (pending.length < 2) return;
          let length = pending[1] & 0x7f;
          let head = 2;
          if (length === 126) { if (pending.length < 4) return; length = pending.readUInt16BE(2); head = 4; }
          else if (length === 127) { if (pending.length < 10) return; length = Number(pending.readBigUInt64BE(2)); head = 10; }
          if (pending.length < head + length) return;
          if (pending[0] === 0x81) onMessage(JSON.parse(pending.subarray(head, head + length).toString('utf8')));
          pending = pending.subarray(head + length);
        }
      };
      socket.on('data', (chunk) => { pending = Buffer.concat([pending, chunk]); take(); });
      socket.on('error', () => {});
      take();
      resolve({status: response.statusCode, close: () => socket.destroy()});
    });
    request.on('response', (response) => reject(new Error(`no upgrade: ${response.statusCode}`)));
    request.on('error', reject);
    request.end();
  });
}

// Calls onEvent({id, data}) for each event; id is undefined for pose frames.
export function openEvents(port, path, headers, onEvent) {
  return new Promise((resolve, reject) => {
    const request = http.request({port, host: '127.0.0.1', path, headers, agent: false});
    request.on('response', (response) => {
      let pending = '';
      response.setEncoding('utf8');
      response.on('error', () => {});
      response.on('data', (chunk) => {
        pending += chunk;
        for (let end; (end = pending.indexOf('\n\n')) >= 0; pending = pending.slice(end + 2)) {
          const lines = pending.slice(0, end).split('\n');
          const data = lines.filter((line) => line.startsWith('data: ')).map((line) => line.slice(6)).join('\n');
          const id = lines.find((line) => line.startsWith('id: '))?.slice(4);
          if (data) onEvent({id, data: JSON.parse(data)});
        }
      });
      resolve({status: response.statusCode, headers: response.headers, close: () => request.destroy()});
    });
    request.on('error', reject);
    request.end();
  });
}
