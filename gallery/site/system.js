// The page of one system.
import { read, written } from "./address.js";
import { COLOURS } from "./colours.js";
import { Picture } from "./picture.js";
import { Strip } from "./strip.js";

const element = (id) => document.getElementById(id);
const name = location.search.slice(1).split("&")[0];
const [catalogue, equations] = await Promise.all(
    ["catalogue.json", "equations.json"].map(async (file) => (await fetch(file)).json()),
);
const page = catalogue.find((entry) => entry.name === name) ?? catalogue[0];
const source = await WebAssembly.instantiateStreaming(fetch(`${page.name}.wasm`), {});
const module = source.instance.exports;

document.title = `${page.title} in motion`;
element("title").textContent = page.title;
element("about").textContent = page.about;
const { mathml } = equations.find(({ file }) => file.endsWith(`/${page.name}.rs`));
element("equations").innerHTML = mathml;
element("equations").prepend(page.note);
element("view").setAttribute("aria-label", `${page.title}, in motion`);
element("reactions-part").hidden = page.reactions.length === 0;

const picture = new Picture(element("view"), page.view);
const strips = {
    energies: new Strip(element("energies"), [0, 1, 2]),
    reactions: new Strip(element("reactions"), page.reactions.map((_, index) => index)),
};
const parameters = page.parameters.map((slider) => slider.start);
let running = !matchMedia("(prefers-reduced-motion: reduce)").matches;
let chosen = 0;
let dragging = false;

const say = (text) => { element("status").textContent = text; };
const forget = () => {
    picture.forget();
    Object.values(strips).forEach((strip) => strip.forget());
};

// Adds a slider with its label and value. Returns the function that shows a value.
const slider = ({ name, unit, range: [low, high, step], start }, group, index, set) => {
    const row = document.createElement("div");
    const label = document.createElement("label");
    const output = document.createElement("output");
    const input = document.createElement("input");
    row.className = "slider";
    input.id = `${group}-${index}`;
    label.htmlFor = input.id;
    output.htmlFor = input.id;
    label.textContent = name;
    Object.assign(input, { type: "range", min: low, max: high, step, value: start });
    const show = (value) => {
        output.textContent = `${Number(value.toFixed(3))} ${unit}`.trim();
        input.setAttribute("aria-valuetext", output.textContent);
        if (document.activeElement !== input || !input.matches(":active")) input.value = value;
    };
    input.addEventListener("input", () => set(Number(input.value), show));
    row.append(label, output, input);
    element(group).append(row);
    show(start);
    return show;
};

const setParameter = (index, value) => {
    const accepted = module.set_parameter(index, value);
    if (accepted) parameters[index] = value;
    say(accepted ? "" : "No such system can be put together.");
    forget();
    keep();
    return accepted;
};
const showParameter = page.parameters.map((entry, index) =>
    slider(entry, "parameters", index, (value, show) => {
        setParameter(index, value);
        show(parameters[index]);
    }),
);
const showSetting = page.settings.map((entry, index) =>
    slider(entry, "settings", index, (value) => {
        say(module.set(index, value) ? "" : "The system cannot be there.");
        forget();
        keep();
    }),
);

// Adds rows with the colours of their curves to a table. Returns the cells for the numbers.
const rows = (table, names) => names.map((name, index) => {
    const row = table.tBodies[0].insertRow();
    const head = document.createElement("th");
    const swatch = document.createElement("span");
    head.scope = "row";
    swatch.className = "swatch";
    swatch.style.background = COLOURS[index];
    head.append(swatch, name);
    row.append(head);
    return row.insertCell();
});
const energyCells = rows(element("energy-table"), ["kinetic [J]", "potential [J]", "total [J]"]);
const change = rows(element("energy-table"), [page.conservative ? "error of the total [J]" : "change of the total [J]"])[0];
change.previousSibling.firstChild.style.background = "none";
const reactionCells = rows(element("reaction-table"), page.reactions);
const shown = (value) => (Math.abs(value) < 1e-3 && value !== 0 ? value.toExponential(1) : value.toFixed(3));

const energies = () => [module.part(0), module.part(1), module.part(0) + module.part(1)];
const reactions = () => page.reactions.map((_, index) => module.reaction(index));

// The address follows, but not at every frame.
let kept = 0;
const keep = () => {
    kept = performance.now();
    history.replaceState(null, "", written(page, parameters, module));
};

const restore = () => {
    const starts = page.parameters.map((entry) => entry.start);
    // Sets all parameters first: on the way from one system to another a state may be impossible.
    const assume = (values) => values.forEach((value, index) => {
        module.assume_parameter(index, value);
        parameters[index] = value;
    });
    const begin = () => page.settings.every((entry, index) => module.set(index, entry.start));
    const from = read(page);
    assume(from.parameters ?? starts);
    from.state?.forEach((value, index) => module.set_number(index, value));
    if (!(from.state ? module.settle() : begin())) {
        assume(starts);
        begin();
        say("The address holds no state of this system.");
    }
    showParameter.forEach((show, index) => show(parameters[index]));
    forget();
};
restore();
addEventListener("hashchange", restore);

const run = (on) => {
    running = on;
    element("run").textContent = on ? "Pause" : "Run";
    say(on ? "" : `Paused at ${module.time().toFixed(2)} s.`);
    keep();
};
element("run").addEventListener("click", () => run(!running));
element("reset").addEventListener("click", () => {
    history.replaceState(null, "", location.pathname + location.search);
    restore();
    say("Begun anew.");
});
element("link").addEventListener("click", async () => {
    keep();
    const copied = await navigator.clipboard?.writeText(location.href).then(() => true, () => false);
    say(copied ? "The link is copied." : "The link is in the address bar.");
});

const drag = (x, y) => {
    module.drag(chosen, x, y);
    forget();
};
const view = element("view");
view.addEventListener("pointerdown", (event) => {
    const [x, y] = picture.place(event);
    const distance = (index) => Math.hypot(module.handle(index, 0) - x, module.handle(index, 1) - y);
    const all = Array.from({ length: module.handles() }, (_, index) => index);
    chosen = all.reduce((best, index) => (distance(index) < distance(best) ? index : best), 0);
    // A finger covers a tenth of the picture.
    if (distance(chosen) > 0.1 * picture.height) return;
    dragging = true;
    view.setPointerCapture(event.pointerId);
    drag(x, y);
});
view.addEventListener("pointermove", (event) => { if (dragging) drag(...picture.place(event)); });
for (const end of ["pointerup", "pointercancel"]) {
    view.addEventListener(end, () => { if (dragging) { dragging = false; keep(); } });
}
const STEPS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
view.addEventListener("keydown", (event) => {
    const step = STEPS[event.key];
    if (step) {
        const [x, y] = [0, 1].map((axis) => module.handle(chosen, axis) + (step[axis] * picture.height) / 40);
        drag(x, y);
        say(`Part ${chosen + 1} at ${shown(module.handle(chosen, 0))}, ${shown(module.handle(chosen, 1))}.`);
        keep();
    } else if (event.key === "n" || event.key === "N") {
        chosen = (chosen + 1) % module.handles();
        say(`Part ${chosen + 1} of ${module.handles()}.`);
    } else if (event.key === " ") {
        run(!running);
    } else {
        return;
    }
    event.preventDefault();
});

let last = performance.now();
let tabled = 0;
const frame = (now) => {
    // A page that was hidden goes on where it was.
    const elapsed = Math.min(Math.max(now - last, 0) / 1000, 0.05);
    last = now;
    if (running && !dragging) {
        if (!module.advance(elapsed)) {
            run(false);
            say(`The motion ended at ${module.time().toFixed(3)} s: there is no way on from this state.`);
        }
        strips.energies.add(module.time(), energies());
        strips.reactions.add(module.time(), reactions());
        if (now - kept > 1000) keep();
    }
    picture.draw(module, chosen);
    if (now - tabled > 200) {
        tabled = now;
        energies().forEach((value, index) => { energyCells[index].textContent = shown(value); });
        change.textContent = module.change().toExponential(1);
        reactions().forEach((value, index) => { reactionCells[index].textContent = shown(value); });
        showSetting.forEach((show, index) => show(module.setting(index)));
        strips.energies.draw();
        if (page.reactions.length > 0) strips.reactions.draw();
    }
    requestAnimationFrame(frame);
};
run(running);
requestAnimationFrame(frame);
// What tests ask.
window.gallery = { page, module };
