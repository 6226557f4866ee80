// Runs beside the page: what a long text comes to.

import { composed } from './composed';

self.addEventListener('message', ({ data }: MessageEvent<string>) => self.postMessage(composed(data)));
