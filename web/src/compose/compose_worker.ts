// The web worker of long_text.ts: reads a long text without blocking the page.

import { composed } from './composed';

self.addEventListener('message', ({ data }: MessageEvent<string>) => self.postMessage(composed(data)));
