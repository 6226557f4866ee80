import type { Plugin } from 'vite';
import { defineConfig } from 'vitest/config';

// `npm run dev` serves the page from source and forwards API requests to a running server.
const server = process.env['ARMLOOM_SERVER'] ?? 'http://127.0.0.1:8080';

// The content security policy: only the page's own files. `npm run dev` omits it, because Vite
// injects styles.
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
  // Tests check the colors in the style sheets; the timeout allows for a busy machine.
  test: { include: ['test/**/*.test.ts'], environment: 'node', css: true, testTimeout: 60_000 },
});
