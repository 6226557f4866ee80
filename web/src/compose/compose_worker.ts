// Web worker that reads a long text (long_text.ts).

import { composed } from './composed';

self.addEventListener('message', ({ data }: MessageEvent<string>) => self.postMessage(composed(data)));
