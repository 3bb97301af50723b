// Every page in a real browser. `scripts/gallery.sh test` builds the pages and runs this.
import assert from "node:assert/strict";
import { mkdirSync, readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { after, before, test } from "node:test";
import { chromium } from "playwright-core";
import { serve } from "./server.mjs";

const { CHROMIUM, SITE, SCREENS } = process.env;
const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
const pages = JSON.parse(readFileSync(`${SITE}/catalogue.json`));
const PHONE = { width: 360, height: 740 };
const DESK = { width: 1200, height: 900 };
let server;
let browser;
let origin;

before(async () => {
    mkdirSync(SCREENS, { recursive: true });
    server = await serve(SITE, 0);
    origin = `http://localhost:${server.address().port}`;
    browser = await chromium.launch({ executablePath: CHROMIUM, args: ["--no-sandbox"] });
});
after(async () => {
    await browser?.close();
    server?.close();
});

// A page, one that moves unless it should not. `close` fails the test if there were errors, failed requests,
// or requests of what is elsewhere.
async function opened(path, { viewport = DESK, still = false } = {}) {
    const context = await browser.newContext({ viewport, reducedMotion: still ? "reduce" : "no-preference" });
    const page = await context.newPage();
    const wrong = [];
    page.on("pageerror", (error) => wrong.push(String(error)));
    page.on("console", (message) => { if (message.type() === "error") wrong.push(message.text()); });
    page.on("requestfailed", (request) => wrong.push(`${request.url()} failed`));
    page.on("request", (request) => { if (!request.url().startsWith(origin)) wrong.push(`${request.url()} is elsewhere`); });
    await page.goto(`${origin}/${path}`);
    if (path !== "") await page.waitForFunction(() => window.gallery);
    return { page, close: async () => { await context.close(); assert.deepEqual(wrong, []); } };
}

const time = (page) => page.evaluate(() => window.gallery.module.time());
const numbers = (page, count) =>
    page.evaluate((count) => Array.from({ length: count }, (_, index) => window.gallery.module.number(index)), count);
async function accessible(page) {
    await page.evaluate(axe);
    const { violations } = await page.evaluate(() => window.axe.run());
    assert.deepEqual(violations.map(({ id, nodes }) => `${id}: ${nodes.map((node) => node.html)}`), []);
}

// Equations are set as formulas, and what reads them aloud is told so.
async function equationsAreRead(page) {
    assert.match(await page.textContent("#equations math"), /=/);
    const { height } = await page.locator("#equations math").boundingBox();
    assert.ok(height > 10, `the equations are ${height} px high`);
    const session = await page.context().newCDPSession(page);
    const { nodes } = await session.send("Accessibility.getFullAXTree");
    const roles = nodes.map((node) => node.role?.value);
    assert.ok(roles.includes("MathMLMath") && roles.includes("MathMLOperator"), [...new Set(roles)].join(", "));
}

async function fits(page) {
    const width = await page.evaluate(() => document.documentElement.scrollWidth);
    assert.ok(width <= PHONE.width, `the page is ${width} px wide on a phone of ${PHONE.width} px`);
}

for (const { name, title, parameters, coordinates, conservative, reactions } of pages) {
    test(`${name}: it moves, and pauses`, async () => {
        const { page, close } = await opened(`system.html?${name}`);
        assert.equal(await page.textContent("h1"), title);
        const [from, wall] = [await time(page), Date.now()];
        await page.waitForTimeout(1500);
        const [moved, passed] = [(await time(page)) - from, (Date.now() - wall) / 1000];
        // Real time, but for frames longer than a twentieth of a second, of which a busy machine may have
        // some.
        assert.ok(moved > 0.3 * passed && moved < passed + 0.1, `${moved} s of motion in ${passed} s`);
        await page.screenshot({ path: `${SCREENS}/${name}.png`, fullPage: true });
        await page.click("#run");
        const stopped = await time(page);
        await page.waitForTimeout(200);
        assert.equal(await time(page), stopped);
        await page.click("#run");
        await page.waitForFunction((stopped) => window.gallery.module.time() > stopped, stopped);
        await equationsAreRead(page);
        assert.equal(await page.isVisible("#reactions-part"), reactions.length > 0);
        await close();
    });

    test(`${name}: sliders act`, async () => {
        const { page, close } = await opened(`system.html?${name}`, { still: true });
        for (let index = 0; index < parameters.length; index += 1) {
            const before = await page.inputValue(`#parameters-${index}`);
            await page.focus(`#parameters-${index}`);
            await page.keyboard.press("ArrowRight");
            if ((await page.inputValue(`#parameters-${index}`)) === before) await page.keyboard.press("ArrowLeft");
            const set = await page.inputValue(`#parameters-${index}`);
            assert.notEqual(set, before, parameters[index].name);
            const address = decodeURIComponent(new URL(page.url()).hash);
            const kept = new URLSearchParams(address.slice(1)).get("p").split(",").map(Number);
            assert.equal(kept[index], Number(set), parameters[index].name);
        }
        const state = await numbers(page, 2 * coordinates);
        await page.focus("#settings-0");
        await page.keyboard.press("PageDown");
        assert.notDeepEqual(await numbers(page, 2 * coordinates), state);
        await page.click("#run");
        const from = await time(page);
        await page.waitForFunction((from) => window.gallery.module.time() > from + 0.1, from);
        await close();
    });

    test(`${name}: what moves is dragged, by hand and by keys`, async () => {
        const { page, close } = await opened(`system.html?${name}`, { still: true });
        const [x, y] = await page.evaluate(() => {
            const { page: { view: [left, bottom, right, top] }, module } = window.gallery;
            const box = document.getElementById("view").getBoundingClientRect();
            return [
                box.left + ((module.handle(0, 0) - left) / (right - left)) * box.width,
                box.bottom - ((module.handle(0, 1) - bottom) / (top - bottom)) * box.height,
            ];
        });
        const place = () => page.evaluate(() => [0, 1].map((axis) => window.gallery.module.handle(0, axis)));
        const before = await place();
        await page.mouse.move(x, y);
        await page.mouse.down();
        await page.mouse.move(x + 25, y + 5);
        await page.mouse.up();
        const dragged = await place();
        assert.notDeepEqual(dragged, before);
        await page.focus("#view");
        await page.keyboard.press("ArrowRight");
        await page.keyboard.press("ArrowUp");
        assert.notDeepEqual(await place(), dragged);
        await page.keyboard.press("n");
        assert.match(await page.textContent("#status"), /Part \d/);
        await page.keyboard.press("Space");
        assert.equal(await page.textContent("#run"), "Pause");
        await close();
    });

    test(`${name}: an address holds the whole state`, async () => {
        const { page, close } = await opened(`system.html?${name}`);
        await page.waitForTimeout(700);
        await page.click("#run");
        // Parameters far from those of the start, as far as the state allows them.
        for (let index = 0; index < parameters.length; index += 1) {
            await page.focus(`#parameters-${index}`);
            for (const key of ["PageUp", "PageUp", "PageUp"]) await page.keyboard.press(key);
        }
        const sliders = (page) => page.$$eval("#parameters input", (inputs) => inputs.map(({ value }) => value));
        const set = await sliders(page);
        const state = await numbers(page, 2 * coordinates);
        const other = await opened(`system.html?${name}${new URL(page.url()).hash}`, { still: true });
        const restored = await numbers(other.page, 2 * coordinates);
        // On constraints a start loses its rounding errors.
        const scale = Math.max(...state.map(Math.abs), 1);
        restored.forEach((value, index) => {
            assert.ok(Math.abs(value - state[index]) < 1e-12 * scale, `${restored}, not ${state}`);
        });
        assert.deepEqual(await sliders(other.page), set);
        await other.close();
        const bad = await opened(`system.html?${name}#p=1&x=nonsense`);
        await bad.page.waitForFunction(() => window.gallery.module.time() > 0);
        await bad.close();
        await close();
    });

    test(`${name}: an hour of motion`, async () => {
        const { page, close } = await opened(`system.html?${name}`, { still: true });
        // Frame by frame where the energy is checked, else second by second.
        const found = await page.evaluate((step) => {
            const { module } = window.gallery;
            const until = module.time() + 3600;
            const origin = module.change();
            let scale = 0;
            const start = performance.now();
            while (module.time() < until) {
                if (!module.advance(step)) return { ended: module.time() };
                scale = Math.max(scale, Math.abs(module.part(0)));
            }
            return { error: module.change() - origin, scale, took: performance.now() - start };
        }, conservative ? 1 / 60 : 1);
        console.log(`${name}: an hour in ${(found.took / 1000).toFixed(2)} s, energy changed by ${found.error} J of ${found.scale} J`);
        assert.equal(found.ended, undefined);
        // As many frames as an hour has, each with the tolerance of 1e-13, if all errors had one sign.
        const allowed = 3600 * 60 * 1e-13 * found.scale;
        if (conservative) assert.ok(Math.abs(found.error) < allowed, `the energy changed by ${found.error} J`);
        await close();
    });

    test(`${name}: for screen readers and on a phone`, async () => {
        const { page, close } = await opened(`system.html?${name}`, { viewport: PHONE });
        await page.waitForTimeout(600);
        await fits(page);
        await accessible(page);
        await page.screenshot({ path: `${SCREENS}/${name}.phone.png`, fullPage: true });
        await close();
    });
}

test("the list of all systems", async () => {
    const { page, close } = await opened("", { viewport: PHONE });
    await page.waitForSelector("#systems li:nth-child(9)");
    await fits(page);
    await accessible(page);
    await page.screenshot({ path: `${SCREENS}/index.png`, fullPage: true });
    await page.click("text=Four-bar linkage");
    await page.waitForFunction(() => window.gallery?.page.name === "four_bar");
    await close();
});

test("a thousand double pendulums", async () => {
    const { page, close } = await opened("thousand.html");
    await page.waitForFunction(() => Number(document.getElementById("rate").textContent) > 0 && window.gallery.time() > 1);
    const shown = async (id) => Number(await page.textContent(`#${id}`));
    const [rate, cost, error] = [await shown("rate"), await shown("cost"), await shown("error")];
    console.log(`thousand: ${rate} frames a second, ${cost} ms of mechanics a frame, energy error ${error}`);
    assert.ok(error > 0 && error < 1e-8, `an energy is off by ${error}`);
    await accessible(page);
    // Half a minute later they have parted.
    const parted = await page.evaluate(() => {
        const { module } = window.gallery;
        for (let frame = 0; frame < 1800; frame += 1) if (module.advance(1 / 60) !== 0) return "ended";
        return Math.abs(module.angle(0, 0) - module.angle(999, 0));
    });
    assert.ok(parted > 1e-2, `the first and the last are ${parted} rad apart`);
    await page.waitForTimeout(600);
    await page.screenshot({ path: `${SCREENS}/thousand.png` });
    await close();
});

test("without a wish for motion nothing moves", async () => {
    const { page, close } = await opened("system.html?double_pendulum", { still: true });
    await page.waitForTimeout(300);
    assert.equal(await time(page), 0);
    assert.equal(await page.textContent("#run"), "Run");
    await close();
});
