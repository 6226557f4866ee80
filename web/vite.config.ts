import type { Plugin } from 'vite';
import { defineConfig } from 'vitest/config';

// `npm run dev` shows the page from source beside a running server; the server itself serves dist/.
const server = process.env['ARMLOOM_SERVER'] ?? 'http://127.0.0.1:8080';

// What the page may load and run: its own files, and nothing else. `npm run dev` goes without, as it
// puts styles into the page by itself.
const policy = [
  "default-src 'none'", "script-src 'self'", "style-src 'self'", "font-src 'self'", "img-src 'self'", "connect-src 'self'",
  "base-uri 'none'", "form-action 'none'",
].join('; ');
const content_policy: Plugin = {
  name: 'content-policy',
  apply: 'build',
  transformIndexHtml: () => [{ tag: 'meta', attrs: { 'http-equiv': 'Content-Security-Policy', content: policy }, injectTo: 'head-prepend' }],
};

export default defineConfig({
  base: './',
  plugins: [content_policy],
  build: {
    target: 'es2022',
    assetsInlineLimit: 0,
    chunkSizeWarningLimit: 900,
  },
  server: {
    host: '127.0.0.1',
    proxy: { '/api': { target: server, ws: true } },
  },
  // Colours are tested as they stand in the sheets; a busy machine gets the time that it takes.
  test: { include: ['test/**/*.test.ts'], environment: 'node', css: true, testTimeout: 60_000 },
});
