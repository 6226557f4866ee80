// Prism (npm @stoplight/prism-cli) as a proxy: checks requests and responses against /openapi.json with a
// third-party validator and reports its findings in a header.
import {spawn} from 'node:child_process';
import fs from 'node:fs';
import net from 'node:net';

// Prism needs a given port.
async function freePort() {
  const listener = net.createServer();
  await new Promise((resolve) => listener.listen(0, '127.0.0.1', resolve));
  const {port} = listener.address();
  await new Promise((resolve) => listener.close(resolve));
  return port;
}

// `file`: where the document is written for Prism.
export async function startPrism(binary, document, file, port) {
  fs.writeFileSync(file, JSON.stringify(document));
  const own = await freePort();
  const child = spawn(binary, ['proxy', file, `http://127.0.0.1:${port}`, '-h', '127.0.0.1', '-p', String(own), '--validate-request', 'true'],
                      {stdio: ['ignore', 'pipe', 'inherit']});
  await new Promise((resolve, reject) => {
    let out = '';
    child.stdout.on('data', (text) => {
      out += text;
      if (out.includes('Prism is listening')) resolve();
    });
    child.on('exit', (code) => reject(new Error(`prism ended with ${code}: ${out}`)));
  });
  return {port: own, end: () => child.kill('SIGTERM')};
}

// Returns Prism's findings about the request and the response.
export function violations({headers}) {
  const all = JSON.parse(headers['sl-violations'] ?? '[]');
  const of = (part) => all.filter(({location}) => location?.[0] === part);
  return {request: of('request'), answer: of('response')};
}
