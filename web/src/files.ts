// Grasps as files and links, and pictures of them.
import type { Grasp } from './grasp';

/** A grasp file in YAML, one line for each contact. */
export function yaml(grasp: Grasp): string {
  const { object, contacts, loads, ...head } = grasp;
  return [
    ...Object.entries(head).map(([key, value]) => `${key}: ${flow(value)}`),
    'object:',
    ...Object.entries(object).map(([key, value]) => `  ${key}: ${flow(value)}`),
    ...(loads ? ['loads:', ...loads.map((load) => `  - ${flow(load)}`)] : []),
    'contacts:',
    ...contacts.map((contact) => `  - ${flow(contact)}`),
    '',
  ].join('\n');
}

/** Within one line. */
function flow(value: unknown): string {
  if (Array.isArray(value)) return `[${value.map(flow).join(', ')}]`;
  if (typeof value !== 'object' || value === null) return JSON.stringify(value);
  return `{${Object.entries(value).map(([key, part]) => `${key}: ${flow(part)}`).join(', ')}}`;
}

const through = (bytes: Uint8Array, stream: GenericTransformStream) =>
  new Response(new Blob([bytes as Uint8Array<ArrayBuffer>]).stream().pipeThrough(stream as ReadableWritablePair<Uint8Array<ArrayBuffer>, Uint8Array<ArrayBuffer>>)).arrayBuffer();

/** What follows the # of a link: the grasp, compressed. */
export async function toLink(grasp: Grasp): Promise<string> {
  const bytes = new TextEncoder().encode(JSON.stringify(grasp));
  const packed = new Uint8Array(await through(bytes, new CompressionStream('deflate-raw')));
  const text = btoa(Array.from(packed, (byte) => String.fromCharCode(byte)).join(''));
  return `grasp=${text.replaceAll('+', '-').replaceAll('/', '_').replaceAll('=', '')}`;
}

/** The grasp file in a link; nothing where there is no link, and empty where it is damaged. */
export async function fromLink(hash: string): Promise<Uint8Array | undefined> {
  const [, text] = hash.match(/^#?grasp=(.*)$/s) ?? [];
  if (text === undefined) return undefined;
  try {
    const packed = Uint8Array.from(atob(text.replaceAll('-', '+').replaceAll('_', '/')), (c) => c.charCodeAt(0));
    return new Uint8Array(await through(packed, new DecompressionStream('deflate-raw')));
  } catch {
    return new Uint8Array();
  }
}

/** Offers a file to be kept. */
export function keep(content: BlobPart, type: string, name: string): void {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob([content], { type }));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

/** A file's name from a grasp's. */
export const fileName = (grasp: Grasp) =>
  (grasp.name ?? 'grasp').normalize('NFKD').replace(/[^A-Za-z0-9]+/g, '-').replace(/^-+|-+$/g, '').slice(0, 60).toLowerCase() || 'grasp';

/** Something drawn: lines and text, and below them, in space, what WebGL draws. */
export interface Picture {
  overlay: SVGSVGElement;
  /** As a data: address. */
  image?: string;
  /** What it is read by, to be put beneath. */
  legend?: SVGSVGElement;
}

/** Pictures side by side as one SVG, with the colours and the typeface of the page. */
export function asSvg(pictures: Picture[]): { text: string; width: number; height: number } {
  const style = getComputedStyle(document.documentElement);
  // The colours of now, written out: not every program that shows pictures knows variables.
  const valued = (text: string) => text.replace(/var\((--[a-z]+)\)/g, (_, name: string) => style.getPropertyValue(name).trim());
  const rules = Array.from(document.styleSheets, (sheet) => Array.from(sheet.cssRules))
    .flat()
    .filter((rule) => rule instanceof CSSStyleRule && pictures.some(({ overlay, legend }) => [overlay, legend].some((each) => each?.querySelector(rule.selectorText))))
    .map((rule) => valued(rule.cssText))
    .join('\n');
  const boxes = pictures.map(({ overlay }) => overlay.getBoundingClientRect());
  const edge = pictures.some(({ legend }) => legend) ? 56 : 24;
  const width = boxes.reduce((sum, box) => sum + box.width + 24, 24);
  const height = Math.max(...boxes.map((box) => box.height)) + 2 * edge;
  let left = 24;
  const parts = pictures.map(({ overlay, image, legend }, k) => {
    const { width: w, height: h } = boxes[k]!;
    const top = (height - h) / 2;
    const below = image ? `<image x="${left}" y="${top}" width="${w}" height="${h}" href="${image}"/>` : '';
    const placed = (picture: SVGSVGElement, box: Record<string, number>) => {
      const copy = picture.cloneNode(true) as SVGSVGElement;
      for (const [name, value] of Object.entries(box)) copy.setAttribute(name, String(value));
      return new XMLSerializer().serializeToString(copy);
    };
    const drawn = below + placed(overlay, { x: left, y: top, width: w, height: h });
    const box = legend?.getBoundingClientRect();
    const key = box ? placed(legend!, { x: left + (w - box.width) / 2, y: top + h, width: box.width, height: box.height }) : '';
    left += w + 24;
    return drawn + key;
  });
  const escaped = rules.replaceAll('&', '&amp;').replaceAll('<', '&lt;');
  const font = `font: 14px ${getComputedStyle(document.body).fontFamily.replaceAll('"', "'")}`;
  const text = `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" viewBox="0 0 ${width} ${height}" style="${font}">
<style>${escaped}</style><rect width="100%" height="100%" fill="${valued('var(--ground)')}"/>${parts.join('')}</svg>\n`;
  return { text, width, height };
}

/** The same in dots, two for each pixel. */
export async function asPng(pictures: Picture[]): Promise<Blob> {
  const { text, width, height } = asSvg(pictures);
  const image = new Image();
  image.src = `data:image/svg+xml,${encodeURIComponent(text)}`;
  await image.decode();
  const canvas = document.createElement('canvas');
  [canvas.width, canvas.height] = [2 * width, 2 * height];
  canvas.getContext('2d')!.drawImage(image, 0, 0, canvas.width, canvas.height);
  return new Promise((done, fail) => canvas.toBlob((blob) => (blob ? done(blob) : fail(new Error('no picture')))));
}
