import { defineConfig } from 'vitest/config';

// `npm run dev` shows the page from source beside a running server; the server itself serves dist/.
const server = process.env['ARMLOOM_SERVER'] ?? 'http://127.0.0.1:8080';

export default defineConfig({
  base: './',
  build: {
    target: 'es2022',
    assetsInlineLimit: 0,
    chunkSizeWarningLimit: 900,
  },
  server: {
    host: '127.0.0.1',
    proxy: { '/api': { target: server, ws: true } },
  },
  test: { include: ['test/**/*.test.ts'], environment: 'node' },
});
