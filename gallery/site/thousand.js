// A thousand motions in one page, as fast as frames go.
const COUNT = 1000;
// The angle of all rods at the start, and the distance of neighbours [rad].
const [ANGLE, SPREAD] = [2.2, 1e-9];
// The longest time of motion in a frame [s]: slower machines show a slower motion.
const LONGEST = 1 / 20;

const element = (id) => document.getElementById(id);
const { instance } = await WebAssembly.instantiateStreaming(fetch("thousand.wasm"), {});
const module = instance.exports;
const canvas = element("view");
const pen = canvas.getContext("2d");
canvas.style.aspectRatio = "1 / 1";
canvas.style.maxWidth = "40rem";

let running = !matchMedia("(prefers-reduced-motion: reduce)").matches;
let time = 0;
const begin = () => {
    module.begin(COUNT, ANGLE, SPREAD);
    time = 0;
};
begin();
const label = () => { element("run").textContent = running ? "Pause" : "Run"; };
label();
element("run").addEventListener("click", () => { running = !running; label(); });
element("reset").addEventListener("click", begin);

const draw = () => {
    const size = Math.round(canvas.clientWidth * Math.min(devicePixelRatio, 2));
    if (canvas.width !== size) canvas.width = canvas.height = size;
    const [middle, unit] = [size / 2, size / 4.3];
    pen.clearRect(0, 0, size, size);
    pen.lineWidth = 1;
    for (let k = 0; k < COUNT; k += 1) {
        const [upper, lower] = [module.angle(k, 0), module.angle(k, 1)];
        const [x, y] = [middle + unit * Math.sin(upper), middle + unit * Math.cos(upper)];
        pen.strokeStyle = `hsl(${(330 * k) / COUNT} 70% 45% / 25%)`;
        pen.beginPath();
        pen.moveTo(middle, middle);
        pen.lineTo(x, y);
        pen.lineTo(x + unit * Math.sin(lower), y + unit * Math.cos(lower));
        pen.stroke();
    }
};

let [frames, cost, since] = [0, 0, performance.now()];
let last = since;
const frame = (now) => {
    const passed = Math.min(Math.max(now - last, 0) / 1000, LONGEST);
    last = now;
    if (running) {
        const start = performance.now();
        module.advance(passed);
        cost += performance.now() - start;
        time += passed;
    }
    draw();
    frames += 1;
    if (now - since > 500) {
        element("rate").textContent = ((1000 * frames) / (now - since)).toFixed(0);
        element("cost").textContent = (cost / frames).toFixed(2);
        element("time").textContent = time.toFixed(1);
        element("error").textContent = module.worst(ANGLE, SPREAD).toExponential(1);
        [frames, cost, since] = [0, 0, now];
    }
    requestAnimationFrame(frame);
};
requestAnimationFrame(frame);
window.gallery = { module, time: () => time };
