// Pictures by hand.
import type { Point } from './grasp';

type Attributes = Record<string, string | number>;

export function node<Name extends keyof SVGElementTagNameMap>(
  name: Name,
  attributes: Attributes = {},
  ...children: (Node | string)[]
): SVGElementTagNameMap[Name] {
  const element = document.createElementNS('http://www.w3.org/2000/svg', name);
  set(element, attributes);
  element.append(...children);
  return element;
}

export function set(element: Element, attributes: Attributes): void {
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, String(value));
}

const short = (value: number) => (Math.round(value * 100) / 100).toString();

export function path(points: Iterable<Point>, closed = false): string {
  const text = Array.from(points, ([x, y], k) => `${k ? 'L' : 'M'}${short(x)} ${short(y)}`).join('');
  return closed ? `${text}Z` : text;
}

export const line = (from: Point, to: Point, kind: string) =>
  node('path', { d: path([from, to]), class: kind });

export function text(words: string, [x, y]: Point, kind: string, anchor = 'middle'): SVGTextElement {
  return node('text', { x: short(x), y: short(y), class: kind, 'text-anchor': anchor }, words);
}

/** An arrow whose tip is just where the force ends; short ones are all head. */
export function arrow(from: Point, to: Point, kind: string): SVGGElement {
  const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
  const size = Math.hypot(dx, dy);
  if (size < 0.5) return node('g');
  const [ux, uy] = [dx / size, dy / size];
  const head = Math.min(13, size);
  const neck: Point = [to[0] - head * ux, to[1] - head * uy];
  const side = 0.42 * head;
  const corners: Point[] = [
    to,
    [neck[0] - side * uy, neck[1] + side * ux],
    [neck[0] + side * uy, neck[1] - side * ux],
  ];
  const shaft: Point = [to[0] - 0.7 * head * ux, to[1] - 0.7 * head * uy];
  return node(
    'g',
    { class: `arrow ${kind}` },
    node('path', { d: path([from, shaft]), class: 'shaft' }),
    node('path', { d: path(corners, true), class: 'head' }),
  );
}

/** Where the pointer is, in pixels of the picture. */
export function place(picture: SVGSVGElement, event: PointerEvent): Point {
  const box = picture.getBoundingClientRect();
  return [event.clientX - box.left, event.clientY - box.top];
}

/** Follows the pointer from where it goes down on an element; `begin` may refuse. What is dragged by
 * that gets the focus: not for all to see, until a key is pressed. */
export function draggable(
  element: SVGElement,
  begin: (event: PointerEvent) => ((event: PointerEvent) => void) | undefined,
  dragged = element,
): void {
  element.addEventListener('pointerdown', (event) => {
    if (event.button !== 0) return;
    const move = begin(event);
    if (!move) return;
    event.stopPropagation();
    event.preventDefault();
    dragged.focus();
    dragged.dataset.hand = 'down';
    element.setPointerCapture(event.pointerId);
    const end = () => {
      if (dragged.dataset.hand) dragged.dataset.hand = 'up';
      element.removeEventListener('pointermove', move);
      element.removeEventListener('pointerup', end);
      element.removeEventListener('pointercancel', end);
    };
    element.addEventListener('pointermove', move);
    element.addEventListener('pointerup', end);
    element.addEventListener('pointercancel', end);
  });
  for (const kind of ['keydown', 'blur']) dragged.addEventListener(kind, () => delete dragged.dataset.hand);
}

/** Arrow keys as steps: right and up are forwards; with Shift a tenth. */
export function keySteps(element: SVGElement, step: (dx: number, dy: number) => void): void {
  element.addEventListener('keydown', (event) => {
    const size = event.shiftKey ? 0.1 : 1;
    const steps: Record<string, [number, number]> = {
      ArrowRight: [size, 0],
      ArrowLeft: [-size, 0],
      ArrowUp: [0, size],
      ArrowDown: [0, -size],
    };
    const found = steps[event.key];
    if (!found) return;
    event.preventDefault();
    step(...found);
  });
}
