// Curves of the last ten seconds.
import { COLOURS } from "./colours.js";

// In seconds of motion.
const SPAN = 10;

export class Strip {
    constructor(canvas, colours) {
        this.canvas = canvas;
        this.pen = canvas.getContext("2d");
        this.colours = colours;
        this.samples = [];
        canvas.style.aspectRatio = "3 / 1";
    }

    forget() {
        this.samples = [];
    }

    add(t, values) {
        this.samples.push([t, ...values]);
        while (this.samples[0][0] < t - SPAN) this.samples.shift();
    }

    draw() {
        const { canvas, pen, samples } = this;
        canvas.width = Math.round(canvas.clientWidth * devicePixelRatio);
        canvas.height = Math.round(canvas.clientHeight * devicePixelRatio);
        const values = samples.flatMap(([, ...row]) => row).filter(Number.isFinite);
        if (values.length === 0) return;
        let low = 0;
        let high = 0;
        for (const value of values) [low, high] = [Math.min(low, value), Math.max(high, value)];
        const room = 0.08 * (high - low) || 1;
        const [bottom, top] = [low - room, high + room];
        const start = Math.max(samples[0][0], samples.at(-1)[0] - SPAN);
        const x = (t) => ((t - start) / SPAN) * canvas.width;
        const y = (value) => ((top - value) / (top - bottom)) * canvas.height;
        pen.lineWidth = devicePixelRatio;
        pen.strokeStyle = "#bbb";
        pen.beginPath();
        pen.moveTo(0, y(0));
        pen.lineTo(canvas.width, y(0));
        pen.stroke();
        pen.lineWidth = 1.6 * devicePixelRatio;
        this.colours.forEach((colour, index) => {
            pen.strokeStyle = COLOURS[colour];
            pen.beginPath();
            for (const row of samples) pen.lineTo(x(row[0]), y(row[index + 1]));
            pen.stroke();
        });
    }
}
