// Bodies in space on a canvas, by WebGL: seen from afar, so that lengths are the same everywhere.
import type { Vec } from './grasp';
import type { Body } from './mesh';
import { turned, type Turn } from './turn';

export type Colour = readonly [number, number, number];

/** A CSS variable such as --force. */
export function colour(name: string): Colour {
  const text = getComputedStyle(document.documentElement).getPropertyValue(name).trim().slice(1);
  const digits = text.length === 3 ? [...text].map((digit) => digit + digit).join('') : text;
  const part = (k: number) => parseInt(digits.slice(2 * k, 2 * k + 2), 16) / 255;
  return [part(0), part(1), part(2)];
}

/** From a body's own frame to the world: stretched along its axes, turned, moved. */
export interface Pose {
  turn: Turn;
  stretch?: Vec;
  at?: Vec;
}

/** How the world is seen: x to the right, y upwards, z towards the eye. */
export interface Eye {
  turn: Turn;
  /** Shown in the middle. */
  centre: Vec;
  /** Pixels for a metre. */
  scale: number;
  /** Half of the depth that is shown [m]. */
  depth: number;
}

export const seen = (eye: Eye, p: Vec): Vec => {
  const [x, y, z] = turned(eye.turn, [p[0] - eye.centre[0], p[1] - eye.centre[1], p[2] - eye.centre[2]]);
  return [eye.scale * x, eye.scale * y, eye.scale * z];
};

const placing = `
  uniform mat3 turn, view; uniform vec3 stretch, at, centre; uniform vec2 half_size; uniform float scale, depth;
  vec4 placed(vec3 p) {
    vec3 q = view * (turn * (stretch * p) + at - centre);
    return vec4(scale * q.xy / half_size, -q.z / depth, 1.0);
  }`;

const litVertex = `#version 300 es
  in vec3 position, normal; out vec3 facing;
  ${placing}
  void main() {
    facing = view * turn * (normal / stretch);
    gl_Position = placed(position);
  }`;
const litFragment = `#version 300 es
  precision highp float;
  in vec3 facing; out vec4 result;
  uniform vec4 tint; uniform float rim;
  void main() {
    vec3 n = normalize(gl_FrontFacing ? facing : -facing);
    float light = 0.72 + 0.2 * dot(n, normalize(vec3(-0.4, 0.8, 0.5))) + 0.1 * n.z;
    float edge = rim * pow(1.0 - abs(n.z), 3.0);
    float alpha = mix(tint.a, 1.0, edge);
    result = vec4(tint.rgb * mix(light, 0.55, edge) * alpha, alpha);
  }`;
// A line as a strip as wide as is wanted.
const lineVertex = `#version 300 es
  in vec3 position, other; in float side;
  ${placing}
  uniform float width;
  void main() {
    vec4 p = placed(position), q = placed(other);
    vec2 way = (q.xy - p.xy) * half_size;
    vec2 across = length(way) > 0.0 ? normalize(vec2(-way.y, way.x)) : vec2(0.0);
    gl_Position = vec4(p.xy + side * width * across / half_size, p.z - 2e-3, 1.0);
  }`;
const lineFragment = `#version 300 es
  precision highp float;
  uniform vec4 tint; out vec4 result;
  void main() { result = vec4(tint.rgb * tint.a, tint.a); }`;
// The sphere of postures: by the logarithm of the force norm, with lines where it is a round number.
const globeVertex = `#version 300 es
  in vec3 position; in vec2 value; out vec3 facing, direction; out vec2 norm;
  ${placing}
  void main() {
    direction = position;
    facing = view * turn * position;
    norm = value;
    gl_Position = placed(position);
  }`;
const globeFragment = `#version 300 es
  precision highp float;
  in vec3 facing, direction; in vec2 norm; out vec4 result;
  uniform vec3 ramp[5]; uniform vec3 unholdable, hatch, ground, tilt_from;
  uniform float low, high, tilt, opacity, dots; uniform float levels[16]; uniform int count;
  void main() {
    float part = clamp((norm.x - low) / max(high - low, 1e-9), 0.0, 1.0);
    int k = min(int(part * 4.0), 3);
    vec3 hue = mix(ramp[k], ramp[k + 1], part * 4.0 - float(k));
    float pixel = fwidth(norm.x);
    for (int i = 0; i < 16; ++i)
      if (i < count) hue = mix(vec3(1.0), hue, 0.45 + 0.55 * smoothstep(0.3, 1.1, abs(norm.x - levels[i]) / max(pixel, 1e-9)));
    float stripe = fract((gl_FragCoord.x + gl_FragCoord.y) / (9.0 * dots));
    vec3 bare = mix(unholdable, hatch, smoothstep(0.6, 0.68, stripe) - smoothstep(0.92, 1.0, stripe));
    float border = max(fwidth(norm.y), 1e-3);
    hue = mix(hue, bare, smoothstep(-border, border, norm.y - 0.5));
    float away = dot(normalize(direction), tilt_from) - tilt;
    if (away < 0.0) hue = mix(hue, ground, 0.72);
    hue *= 0.9 + 0.1 * normalize(facing).z;
    result = vec4(hue * opacity, opacity);
  }`;

type Attributes = Record<string, { size: number; data: Float32Array }>;

/** Triangles on the graphics card. */
export interface Loaded {
  array: WebGLVertexArrayObject;
  count: number;
  buffers: WebGLBuffer[];
}

type Uniforms = Record<string, number | readonly number[] | Turn | Colour[]>;

const flattened = (vectors: readonly (readonly number[])[]) => new Float32Array(vectors.flat());

export class Canvas {
  private readonly gl: WebGL2RenderingContext;
  private readonly programs: Record<'lit' | 'line' | 'globe', WebGLProgram>;
  private half: [number, number] = [1, 1];
  private fine = 1;
  /** For each pixel. */
  private dots = 1;
  private eye!: Eye;

  /** @throws Error where the browser has no WebGL. */
  constructor(readonly element: HTMLCanvasElement) {
    const gl = element.getContext('webgl2', { antialias: true });
    if (!gl) throw new Error('This browser shows nothing in space: it has no WebGL 2.');
    this.gl = gl;
    this.programs = {
      lit: this.program(litVertex, litFragment),
      line: this.program(lineVertex, lineFragment),
      globe: this.program(globeVertex, globeFragment),
    };
  }

  private program(vertex: string, fragment: string): WebGLProgram {
    const { gl } = this;
    const program = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]] as const) {
      const shader = gl.createShader(kind)!;
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader) ?? 'shader');
      gl.attachShader(program, shader);
    }
    ['position', 'normal', 'other', 'side', 'value'].forEach((name, k) => gl.bindAttribLocation(program, k, name));
    gl.linkProgram(program);
    return program;
  }

  load(attributes: Attributes, indices?: Uint32Array): Loaded {
    const { gl } = this;
    const array = gl.createVertexArray();
    const buffers: WebGLBuffer[] = [];
    gl.bindVertexArray(array);
    for (const [name, { size, data }] of Object.entries(attributes)) {
      const place = ['position', 'normal', 'other', 'side', 'value'].indexOf(name);
      const buffer = gl.createBuffer();
      buffers.push(buffer);
      gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
      gl.bufferData(gl.ARRAY_BUFFER, data, gl.STATIC_DRAW);
      gl.enableVertexAttribArray(place);
      gl.vertexAttribPointer(place, size, gl.FLOAT, false, 0, 0);
    }
    if (indices) {
      const buffer = gl.createBuffer();
      buffers.push(buffer);
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, buffer);
      gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, indices, gl.STATIC_DRAW);
    }
    gl.bindVertexArray(null);
    return { array, buffers, count: indices?.length ?? 0 };
  }

  loadBody({ points, triangles, normals }: Pick<Body, 'points' | 'triangles' | 'normals'>): Loaded {
    const corners = triangles.flat().map((k) => points[k]!);
    return this.load(
      { position: { size: 3, data: flattened(corners) }, normal: { size: 3, data: flattened(normals) } },
      Uint32Array.from(corners.keys()),
    );
  }

  loadLines(lines: readonly (readonly [Vec, Vec])[]): Loaded {
    return this.load(
      {
        position: { size: 3, data: flattened(lines.flatMap(([p, q]) => [p, p, q, q])) },
        other: { size: 3, data: flattened(lines.flatMap(([p, q]) => [q, q, p, p])) },
        // Seen from its other end, a line's left is its right.
        side: { size: 1, data: Float32Array.from(lines.flatMap(() => [1, -1, -1, 1])) },
      },
      Uint32Array.from(lines.flatMap((_, k) => [0, 1, 2, 2, 1, 3].map((i) => 4 * k + i))),
    );
  }

  drop(loaded: Loaded | undefined): void {
    if (!loaded) return;
    this.gl.deleteVertexArray(loaded.array);
    loaded.buffers.forEach((buffer) => this.gl.deleteBuffer(buffer));
  }

  /** What is drawn, in twice as many dots each way as the screen has, as the address of a picture. */
  finely(draw: () => void): string {
    this.fine = 2;
    draw();
    const address = this.element.toDataURL();
    this.fine = 1;
    draw();
    return address;
  }

  /** An empty picture. */
  begin(width: number, height: number, eye: Eye): void {
    const { gl, element } = this;
    this.dots = (window.devicePixelRatio || 1) * this.fine;
    const [w, h] = [Math.round(width * this.dots), Math.round(height * this.dots)];
    if (element.width !== w || element.height !== h) Object.assign(element, { width: w, height: h });
    gl.viewport(0, 0, w, h);
    gl.clearColor(0, 0, 0, 0);
    gl.depthMask(true);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    this.half = [width / 2, height / 2];
    this.eye = eye;
  }

  private draw(name: 'lit' | 'line' | 'globe', what: Loaded, { turn, stretch, at }: Pose, uniforms: Uniforms): void {
    const { gl, eye } = this;
    const program = this.programs[name];
    gl.useProgram(program);
    const all: Uniforms = {
      turn,
      stretch: stretch ?? [1, 1, 1],
      at: at ?? [0, 0, 0],
      view: eye.turn,
      centre: eye.centre,
      half_size: this.half,
      scale: eye.scale,
      depth: eye.depth,
      dots: this.dots,
      ...uniforms,
    };
    for (const [key, value] of Object.entries(all)) {
      const place = gl.getUniformLocation(program, key);
      if (typeof value === 'number') {
        if (key === 'count') gl.uniform1i(place, value);
        else gl.uniform1f(place, value);
      } else if (key === 'turn' || key === 'view') gl.uniformMatrix3fv(place, false, (value as Turn).flat());
      else if (Array.isArray(value[0])) gl.uniform3fv(place, (value as Colour[]).flat());
      else if (key === 'levels') gl.uniform1fv(place, value as number[]);
      else if (value.length === 2) gl.uniform2fv(place, value as number[]);
      else if (value.length === 3) gl.uniform3fv(place, value as number[]);
      else gl.uniform4fv(place, value as number[]);
    }
    gl.bindVertexArray(what.array);
    gl.drawElements(gl.TRIANGLES, what.count, gl.UNSIGNED_INT, 0);
  }

  solid(what: Loaded, pose: Pose, tint: Colour): void {
    this.gl.depthMask(true);
    this.draw('lit', what, pose, { tint: [...tint, 1], rim: 0 });
  }

  /** Through which one sees what is behind; first its far side, then its near one. */
  glass(what: Loaded, pose: Pose, tint: Colour, alpha: number, rim = 0): void {
    const { gl } = this;
    gl.depthMask(false);
    gl.enable(gl.CULL_FACE);
    for (const side of [gl.FRONT, gl.BACK]) {
      gl.cullFace(side);
      this.draw('lit', what, pose, { tint: [...tint, alpha], rim });
    }
    gl.disable(gl.CULL_FACE);
  }

  /** What is behind is hidden from now on, without being drawn itself. */
  veil(what: Loaded, pose: Pose): void {
    const { gl } = this;
    gl.depthMask(true);
    gl.colorMask(false, false, false, false);
    this.draw('lit', what, pose, { tint: [0, 0, 0, 0], rim: 0 });
    gl.colorMask(true, true, true, true);
  }

  lines(what: Loaded, pose: Pose, tint: Colour, alpha: number, width: number): void {
    this.gl.depthMask(false);
    this.draw('line', what, pose, { tint: [...tint, alpha], width: width / 2 });
  }

  globe(what: Loaded, pose: Pose, uniforms: Uniforms): void {
    const { gl } = this;
    gl.depthMask(uniforms.opacity === 1);
    gl.enable(gl.CULL_FACE);
    gl.cullFace(gl.BACK);
    this.draw('globe', what, pose, uniforms);
    gl.disable(gl.CULL_FACE);
  }
}
