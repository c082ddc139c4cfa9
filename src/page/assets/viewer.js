'use strict';
// A surface, lines and points that can be turned, by WebGL. Seen without perspective.

const SHADERS = [
  `attribute vec3 place; attribute vec3 normal; attribute vec3 colour;
   uniform mat3 turn; uniform vec2 scale; uniform float nearer; uniform float size;
   varying vec3 seen; varying vec3 shade;
   void main() {
     vec3 at = turn * place;
     gl_Position = vec4(at.xy * scale, -0.4 * at.z * scale.y - nearer, 1.0);
     gl_PointSize = size; seen = turn * normal; shade = colour;
   }`,
  `precision mediump float;
   varying vec3 seen; varying vec3 shade;
   uniform float isLit;
   void main() {
     vec3 n = normalize(seen + vec3(0.0, 0.0, 1e-6)); if (n.z < 0.0) n = -n;
     float light = 0.34 + 0.62 * max(0.0, dot(n, normalize(vec3(-0.45, 0.65, 0.61))))
                 + 0.16 * max(0.0, dot(n, normalize(vec3(0.75, 0.1, 0.65))));
     gl_FragColor = vec4(shade * mix(1.0, pow(light, 0.6), isLit), 1.0);
   }`,
];

// Layers: {kind: 'triangles', 'lines' or 'points', places, normals, colours, corners, colour, size, shown}.
class Viewer {
  constructor(canvas, radius) {
    this.canvas = canvas;
    this.radius = radius;
    this.layers = [];
    this.turn = [[0.84, 0.54, 0], [-0.27, 0.42, 0.87], [0.47, -0.73, 0.5]];
    this.zoom = 1;
    const gl = canvas.getContext('webgl2', { antialias: true, preserveDrawingBuffer: true });
    this.gl = gl;
    if (!gl) {
      canvas.replaceWith(el('p', { class: 'warning' }, 'This browser shows no WebGL: the grain cannot be turned here.'));
      return;
    }
    const program = gl.createProgram();
    SHADERS.forEach((text, at) => {
      const shader = gl.createShader(at ? gl.FRAGMENT_SHADER : gl.VERTEX_SHADER);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    });
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
    gl.useProgram(program);
    gl.enable(gl.DEPTH_TEST);
    this.program = program;
    this.listen();
  }

  listen() {
    let last = null;
    this.canvas.addEventListener('pointerdown', (event) => {
      last = event;
      this.canvas.setPointerCapture(event.pointerId);
    });
    this.canvas.addEventListener('pointermove', (event) => {
      if (!last) return;
      this.turnBy((event.clientX - last.clientX) / 150, (event.clientY - last.clientY) / 150);
      last = event;
    });
    this.canvas.addEventListener('pointerup', () => { last = null; });
    this.canvas.addEventListener('wheel', (event) => {
      event.preventDefault();
      this.zoom = Math.min(20, Math.max(0.3, this.zoom * Math.exp(-event.deltaY / 600)));
      this.draw();
    }, { passive: false });
  }

  // Turns about the upright and the level axis of the picture.
  turnBy(across, down) {
    const [c, s, d, t] = [Math.cos(across), Math.sin(across), Math.cos(down), Math.sin(down)];
    const by = [[c, 0, s], [s * t, d, -c * t], [-s * d, t, c * d]];
    const old = this.turn;
    this.turn = by.map((row) => [0, 1, 2].map((j) => row[0] * old[0][j] + row[1] * old[1][j] + row[2] * old[2][j]));
    this.draw();
  }

  // Looks from aside at what is longest along the first of two axes, and next along the other.
  lookAlong(axes) {
    const [u, v] = axes.map((axis) => axis.map((part) => part / Math.hypot(...axis)));
    const w = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    this.turn = this.turn.map((row) => [0, 1, 2].map((i) => row[0] * u[i] + row[1] * v[i] + row[2] * w[i]));
  }

  add(layer) {
    const gl = this.gl;
    if (!gl) return layer;
    const buffer = (data, target) => {
      const made = gl.createBuffer();
      gl.bindBuffer(target, made);
      gl.bufferData(target, data, gl.STATIC_DRAW);
      return made;
    };
    layer.count = layer.corners ? layer.corners.length : layer.places.length / 3;
    layer.place = buffer(layer.places, gl.ARRAY_BUFFER);
    if (layer.normals) layer.normal = buffer(layer.normals, gl.ARRAY_BUFFER);
    if (layer.corners) layer.index = buffer(layer.corners, gl.ELEMENT_ARRAY_BUFFER);
    layer.shown ??= true;
    this.layers.push(layer);
    this.paint(layer, layer.colours);
    return layer;
  }

  // Gives a surface other colours: three bytes for each of its vertices.
  paint(layer, colours) {
    if (!this.gl || !colours) return;
    layer.paint ??= this.gl.createBuffer();
    this.gl.bindBuffer(this.gl.ARRAY_BUFFER, layer.paint);
    this.gl.bufferData(this.gl.ARRAY_BUFFER, colours, this.gl.STATIC_DRAW);
  }

  clear() {
    for (const layer of this.layers) {
      for (const buffer of [layer.place, layer.normal, layer.index, layer.paint]) this.gl.deleteBuffer(buffer || null);
    }
    this.layers = [];
  }

  draw() {
    const gl = this.gl;
    if (!gl) return;
    const ratio = window.devicePixelRatio || 1;
    const width = Math.max(1, Math.round((this.canvas.clientWidth || this.canvas.width) * ratio));
    const height = Math.max(1, Math.round((this.canvas.clientHeight || this.canvas.height) * ratio));
    if (this.canvas.isConnected && (this.canvas.width !== width || this.canvas.height !== height)) {
      this.canvas.width = width;
      this.canvas.height = height;
    }
    gl.viewport(0, 0, this.canvas.width, this.canvas.height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    const uniform = (name) => gl.getUniformLocation(this.program, name);
    const scale = (0.92 * this.zoom) / this.radius;
    const aspect = this.canvas.width / this.canvas.height;
    gl.uniformMatrix3fv(uniform('turn'), true, this.turn.flat());
    gl.uniform2f(uniform('scale'), aspect > 1 ? scale / aspect : scale, aspect > 1 ? scale : scale * aspect);
    const attribute = (name, buffer, type, isWhole) => {
      const at = gl.getAttribLocation(this.program, name);
      gl.disableVertexAttribArray(at);
      if (!buffer) return at;
      gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
      gl.enableVertexAttribArray(at);
      gl.vertexAttribPointer(at, 3, type, isWhole, 0, 0);
      return at;
    };
    for (const layer of this.layers.filter((layer) => layer.shown)) {
      attribute('place', layer.place, gl.FLOAT, false);
      attribute('normal', layer.normal, gl.FLOAT, false);
      const colour = attribute('colour', layer.paint, gl.UNSIGNED_BYTE, true);
      if (!layer.paint) gl.vertexAttrib3fv(colour, layer.colour());
      gl.uniform1f(uniform('isLit'), layer.normal ? 1 : 0);
      gl.uniform1f(uniform('nearer'), layer.normal ? 0 : 0.006);
      gl.uniform1f(uniform('size'), (layer.size || 1) * ratio);
      if (layer.index) {
        gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, layer.index);
        gl.drawElements(gl.TRIANGLES, layer.count, gl.UNSIGNED_INT, 0);
      } else {
        gl.drawArrays(layer.kind === 'points' ? gl.POINTS : gl.LINES, 0, layer.count);
      }
    }
  }

  // A number that differs where the picture does, and how many pixels are covered.
  digest() {
    const pixels = new Uint8Array(4 * this.canvas.width * this.canvas.height);
    this.gl.readPixels(0, 0, this.canvas.width, this.canvas.height, this.gl.RGBA, this.gl.UNSIGNED_BYTE, pixels);
    let [sum, covered] = [0, 0];
    for (let i = 0; i < pixels.length; i += 4) {
      covered += pixels[i + 3] > 0;
      sum = (Math.imul(sum, 31) + pixels[i] + 7 * pixels[i + 1] + 13 * pixels[i + 2]) | 0;
    }
    return [sum, covered];
  }
}

// Unit normals of a mesh, as means over its triangles.
function normalsOf(places, corners) {
  const normals = new Float32Array(places.length);
  for (let t = 0; t < corners.length; t += 3) {
    const [a, b, c] = [corners[t], corners[t + 1], corners[t + 2]].map((corner) => 3 * corner);
    const [u, v] = [b, c].map((end) => [0, 1, 2].map((i) => places[end + i] - places[a + i]));
    const cross = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    for (const corner of [a, b, c]) cross.forEach((part, i) => { normals[corner + i] += part; });
  }
  return normals;
}

const radiusOf = (places) => {
  let most = 0;
  for (let i = 0; i < places.length; i += 3) most = Math.max(most, Math.hypot(places[i], places[i + 1], places[i + 2]));
  return most || 1;
};
