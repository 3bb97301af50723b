// Draws what a module has drawn as numbers, and tells where in the system a point of the canvas is.
import { COLOURS } from "./colours.js";

// The most points of a path: those of 15 seconds at 60 frames a second.
const TRAIL = 900;

export class Picture {
    constructor(canvas, [left, bottom, right, top]) {
        this.canvas = canvas;
        this.pen = canvas.getContext("2d");
        Object.assign(this, { left, bottom, width: right - left, height: top - bottom });
        this.trails = new Map();
        canvas.style.aspectRatio = `${this.width} / ${this.height}`;
    }

    // As many pixels as the screen has.
    resize() {
        const width = Math.round(this.canvas.clientWidth * devicePixelRatio);
        const height = Math.round(this.canvas.clientHeight * devicePixelRatio);
        if (this.canvas.width !== width || this.canvas.height !== height) {
            this.canvas.width = width;
            this.canvas.height = height;
        }
        this.scale = width / this.width;
    }

    pixel(x, y) {
        return [(x - this.left) * this.scale, this.canvas.height - (y - this.bottom) * this.scale];
    }

    // Where a pointer is, in the units of the system.
    place(event) {
        const box = this.canvas.getBoundingClientRect();
        const x = this.left + ((event.clientX - box.left) / box.width) * this.width;
        return [x, this.bottom + ((box.bottom - event.clientY) / box.height) * this.height];
    }

    forget() {
        this.trails.clear();
    }

    draw(module, chosen) {
        this.resize();
        const { pen } = this;
        const shapes = this.shapes(module);
        pen.clearRect(0, 0, this.canvas.width, this.canvas.height);
        pen.lineJoin = pen.lineCap = "round";
        for (const { kind, colour, numbers } of shapes) {
            if (kind === 4) this.follow(colour, numbers);
        }
        pen.globalAlpha = 0.4;
        for (const [colour, points] of this.trails) this.line(points, COLOURS[colour], 0.35);
        pen.globalAlpha = 1;
        for (const shape of shapes) this.shape(shape);
        const [x, y] = this.pixel(module.handle(chosen, 0), module.handle(chosen, 1));
        if (document.activeElement === this.canvas) this.ring(x, y);
    }

    // Shapes as `src/scene.rs` writes them: the kind (0 line, 1 disc, 2 body, 3 arrow, 4 next point of a
    // path), the colour, how many numbers follow, and these.
    shapes(module) {
        const count = module.draw();
        const shapes = [];
        for (let at = 0; at < count; ) {
            const [kind, colour, length] = [0, 1, 2].map((offset) => module.drawn(at + offset));
            const numbers = Array.from({ length }, (_, index) => module.drawn(at + 3 + index));
            shapes.push({ kind, colour, numbers });
            at += 3 + length;
        }
        return shapes;
    }

    follow(colour, [x, y]) {
        const points = this.trails.get(colour) ?? [];
        points.push(x, y);
        if (points.length > 2 * TRAIL) points.splice(0, 2);
        this.trails.set(colour, points);
    }

    path(numbers) {
        this.pen.beginPath();
        for (let index = 0; index < numbers.length; index += 2) {
            this.pen.lineTo(...this.pixel(numbers[index], numbers[index + 1]));
        }
    }

    line(numbers, colour, width) {
        this.path(numbers);
        this.pen.strokeStyle = colour;
        this.pen.lineWidth = (width * this.canvas.height) / 100;
        this.pen.stroke();
    }

    shape({ kind, colour, numbers }) {
        const { pen } = this;
        pen.fillStyle = pen.strokeStyle = COLOURS[colour];
        if (kind === 0) this.line(numbers, COLOURS[colour], 0.8);
        if (kind === 1) {
            pen.beginPath();
            pen.arc(...this.pixel(numbers[0], numbers[1]), (numbers[2] * this.canvas.height) / 100, 0, 7);
            pen.fill();
        }
        if (kind === 2) {
            this.path(numbers);
            pen.closePath();
            pen.globalAlpha = 0.3;
            pen.fill();
            pen.globalAlpha = 1;
            pen.lineWidth = this.canvas.height / 150;
            pen.stroke();
        }
        if (kind === 3) this.arrow(numbers);
    }

    arrow([x, y, along, up]) {
        const length = Math.hypot(along, up);
        const head = Math.min(0.03 * this.height, length / 2);
        if (!(length > 0)) return;
        const [a, b] = [along / length, up / length];
        const tip = [x + along, y + up];
        const barb = (side) => [tip[0] - head * (a + side * 0.5 * b), tip[1] - head * (b - side * 0.5 * a)];
        this.line([x, y, ...tip, ...barb(1), ...tip, ...barb(-1)], this.pen.strokeStyle, 0.7);
    }

    ring(x, y) {
        this.pen.beginPath();
        this.pen.arc(x, y, this.canvas.height / 25, 0, 7);
        this.pen.strokeStyle = "#005a8f";
        this.pen.lineWidth = this.canvas.height / 200;
        this.pen.stroke();
    }
}
