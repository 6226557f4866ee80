// Compares two PNGs of the same size in a browser page that decodes them.

// Smallest sum of channel differences (0 to 765) of a changed pixel. Antialiasing and soft shadows
// stay below; a robot against the background is far above.
const kLeastDifference = 40;

/** Returns the number of pixels of this color. Each channel may differ by up to `off`. */
export async function pixels_like(browser, png, rgb, off) {
  const page = await browser.newPage();
  try {
    return await page.evaluate(count_like, [png.toString('base64'), rgb, off]);
  } finally {
    await page.close();
  }
}

async function count_like([base64, rgb, off]) {
  const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
  const image = await createImageBitmap(new Blob([bytes], { type: 'image/png' }));
  const g = new OffscreenCanvas(image.width, image.height).getContext('2d');
  g.drawImage(image, 0, 0);
  const { data } = g.getImageData(0, 0, image.width, image.height);
  let count = 0;
  for (let i = 0; i < data.length; i += 4) {
    if (rgb.every((value, k) => Math.abs(data[i + k] - value) <= off)) count += 1;
  }
  return count;
}

/**
 * Returns the number of clearly different pixels, and the center of these pixels as shares of width
 * and height.
 */
export async function difference(browser, a, b) {
  const page = await browser.newPage();
  try {
    return await page.evaluate(compare, [a.toString('base64'), b.toString('base64'), kLeastDifference]);
  } finally {
    await page.close();
  }
}

async function compare([a64, b64, least]) {
  const read = async (base64) => {
    const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
    const image = await createImageBitmap(new Blob([bytes], { type: 'image/png' }));
    const g = new OffscreenCanvas(image.width, image.height).getContext('2d');
    g.drawImage(image, 0, 0);
    return g.getImageData(0, 0, image.width, image.height);
  };
  const [a, b] = [await read(a64), await read(b64)];
  if (a.width !== b.width || a.height !== b.height) throw new Error('the pictures differ in size');
  let count = 0;
  let x = 0;
  let y = 0;
  for (let i = 0; i < a.data.length; i += 4) {
    const apart = [0, 1, 2].reduce((sum, k) => sum + Math.abs(a.data[i + k] - b.data[i + k]), 0);
    if (apart < least) continue;
    count += 1;
    x += (i / 4) % a.width;
    y += Math.floor(i / 4 / a.width);
  }
  return { count, x: x / Math.max(1, count) / a.width, y: y / Math.max(1, count) / a.height };
}

/** Returns the mean color of the square of 7 by 7 pixels around a point, as [r, g, b]. */
export async function color_at(browser, png, { x, y }) {
  const page = await browser.newPage();
  try {
    return await page.evaluate(mean_color, [png.toString('base64'), Math.round(x), Math.round(y)]);
  } finally {
    await page.close();
  }
}

async function mean_color([base64, x, y]) {
  const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
  const image = await createImageBitmap(new Blob([bytes], { type: 'image/png' }));
  const g = new OffscreenCanvas(image.width, image.height).getContext('2d');
  g.drawImage(image, 0, 0);
  const { data } = g.getImageData(x - 3, y - 3, 7, 7);
  const sum = [0, 0, 0];
  for (let i = 0; i < data.length; i += 4) for (const k of [0, 1, 2]) sum[k] += data[i + k];
  return sum.map((value) => value / (data.length / 4));
}
