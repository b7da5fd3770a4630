// The page in a headless Chromium: it moves, keeps the laws, draws faults, follows its sliders. Pictures go to `screenshots`.

import assert from "node:assert/strict";
import { mkdir, readFile } from "node:fs/promises";
import { createServer } from "node:http";
import { after, afterEach, before, beforeEach, test } from "node:test";
import { chromium } from "playwright-core";

const KINDS = { html: "text/html", css: "text/css", js: "text/javascript", wasm: "application/wasm" };
const page_ = new URL("../page/", import.meta.url);
const pictures = new URL("../screenshots/", import.meta.url).pathname;

const server = createServer(async (request, response) => {
  const name = request.url === "/" ? "index.html" : request.url.slice(1);
  try {
    const file = await readFile(new URL(name, page_));
    response.writeHead(200, { "content-type": KINDS[name.split(".").at(-1)] }).end(file);
  } catch {
    response.writeHead(404).end();
  }
});

let browser;
let page;
let said;

before(async () => {
  await new Promise((done) => server.listen(0, "127.0.0.1", done));
  await mkdir(pictures, { recursive: true });
  browser = await chromium.launch({
    executablePath: process.env.CHROMIUM,
    args: ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
      "--disable-component-update", "--disable-sync"],
  });
});

after(async () => {
  await browser?.close();
  server.close();
});

async function open(options = {}) {
  page = await browser.newPage({ viewport: { width: 1280, height: 900 }, ...options });
  said = [];
  page.on("console", (message) => said.push(message.text()));
  page.on("pageerror", (error) => said.push(String(error)));
  await page.goto(`http://127.0.0.1:${server.address().port}/`);
  await says("No mistakes.");
}

beforeEach(() => open());
afterEach(async () => {
  assert.deepEqual(said, []);
  await page.close();
});

const says = (text) => page.locator("#state", { hasText: text }).waitFor({ timeout: 30000 });
const time = () => page.evaluate(() => Number(document.getElementById("stage").dataset.time));
const until = (seconds) =>
  page.waitForFunction((end) => Number(document.getElementById("stage").dataset.time) >= end, seconds, { timeout: 60000 });
/** Drift of the energy, entropy, least entropy of a step, by scheme. */
const numbers = () => page.locator("#balance tbody tr").evaluateAll((rows) =>
  rows.map((row) => Array.from(row.querySelectorAll("data"), (one) => Number(one.value))));
const look = (id) => page.evaluate((name) => document.getElementById(name).toDataURL(), id);
const sheet = () => page.locator("#sheet").inputValue();
const set = (id, part) => page.locator(`#${id}`).evaluate((input, at) => {
  input.value = Math.round(at * Number(input.max));
  input.dispatchEvent(new Event("input"));
}, part);

test("the pendulum moves, and the first scheme alone keeps both laws", async () => {
  const start = await look("stage");
  await page.selectOption("#speed", "4");
  await until(10);
  assert.notEqual(await look("stage"), start);
  await page.waitForTimeout(400);
  const [exact, midpoint] = await numbers();
  // E is 1471 J at the start: 1e-9 J are 7e-13 of it.
  assert.ok(exact[0] < 1e-9, `energy is off by ${exact[0]} J`);
  assert.ok(exact[1] > 0 && exact[2] >= 0, `entropy ${exact}`);
  assert.ok(midpoint[0] > 1e-3, `midpoint is off by ${midpoint[0]} J`);
});

test("a fault is drawn below its place while one types", async () => {
  const text = await sheet();
  await page.locator("#sheet").fill(text.replace("ln(lambda / l)", "ln(lamda / l)"));
  const fault = page.locator(".faults button");
  await fault.waitFor();
  const [, place, , line, carets] = (await fault.textContent()).split("\n");
  assert.equal(place.trim(), "--> line 2, column 21");
  assert.equal(line.slice(carets.indexOf("^"), carets.lastIndexOf("^") + 1), "lamda");
  // The mark in the sheet lies under the letters: column 21 of line 2 of a text with letters of one width.
  const [mark, area] = [page.locator("mark"), page.locator("#sheet")];
  assert.equal(await mark.textContent(), "lamda");
  const [at, box] = [await mark.boundingBox(), await area.boundingBox()];
  const letter = at.width / 5;
  assert.ok(Math.abs(at.x - (box.x + 11 + 20 * letter)) < 1, `${at.x} in ${box.x}`);
  // The last material that was right goes on.
  const now = await time();
  await until(now + 0.5);
  await page.screenshot({ path: `${pictures}/fault.png` });
  await fault.click();
  const chosen = await area.evaluate((one) => one.value.slice(one.selectionStart, one.selectionEnd));
  assert.equal(chosen, "lamda");
  await area.fill(text);
  await says("No mistakes.");
  assert.equal(await page.locator("mark").count(), 0);
});

test("sliders change the sheet and the run", async () => {
  const runFor = async () => {
    await page.selectOption("#speed", "20");
    await until(5);
    await page.waitForTimeout(400);
    return (await numbers())[0][1];
  };
  const before_ = await runFor();
  // From 100 J to the end of the range, in steps as a hand makes them.
  for (const part of [0.6, 0.7, 0.8, 0.9, 1]) await set("parameter-k", part);
  assert.match(await sheet(), /\nk = 1000 J {9}\/\/ stiffness\n/);
  await page.waitForFunction(() => Number(document.getElementById("stage").dataset.time) < 4);
  const after_ = await runFor();
  assert.ok(Math.abs(after_ / before_ - 1) > 0.1, `entropy ${before_}, then ${after_}`);
  await set("setting-step", 0);
  await page.waitForFunction(() => Number(document.getElementById("stage").dataset.time) < 4);
  await until(1);
});

test("all examples run, and a scheme that stops says why", async () => {
  const names = await page.locator("#example option").allTextContents();
  assert.ok(names.length >= 4);
  for (const [index, name] of names.entries()) {
    await page.selectOption("#example", String(index));
    await page.waitForFunction(() => Number(document.getElementById("stage").dataset.time) < 0.5);
    await until(2);
    await page.waitForTimeout(300);
    const [exact] = await numbers();
    assert.ok(exact[0] < 1e-9 && exact[2] >= 0, `${name}: ${exact}`);
    assert.equal(await page.locator("#setting-air").isVisible(), (await sheet()).includes("Temperature"));
    await page.screenshot({ path: `${pictures}/example-${index}.png` });
  }
  await page.selectOption("#example", "0");
  await set("setting-step", 0.825);
  await page.selectOption("#speed", "20");
  const failure = page.locator("td.failure");
  await failure.first().waitFor();
  assert.match(await failure.first().textContent(), /^Stopped: .*smaller step/);
  // The others go on.
  const now = await time();
  await until(now + 5);
  await page.waitForTimeout(300);
  assert.ok((await numbers())[0][0] < 1e-9);
  await page.screenshot({ path: `${pictures}/large-steps.png` });
});

test("nothing that is typed stops the page", async () => {
  const text = await sheet();
  const frames = () => page.evaluate(() => new Promise((done) => {
    let count = 0;
    const start = performance.now();
    const next = () => (performance.now() - start > 1000 ? done(count) : (count++, requestAnimationFrame(next)));
    next();
  }));
  // Long, and nested too deeply for one of the two stacks.
  const long = `|x: Stretch| ${Array.from({ length: 4000 }, (_, n) => `ln(${n + 1} * x).powi(2)`).join(" + ")}`;
  const deep = `|x: Stretch| ${"(".repeat(20000)}x${")".repeat(20000)}`;
  const types = `|x: Stretch| x as ${"&".repeat(30000)}u8`;
  for (const other of [long, deep, types, "", "\u0000", "💧"]) {
    await page.locator("#sheet").fill(other);
    const count = await frames();
    assert.ok(count > 5, `${count} frames in a second`);
  }
  await page.locator("#sheet").fill(text);
  await says("No mistakes.");
  await until(0.5);
});

test("a solver that breaks is started again, with the last material that was right", async () => {
  await page.route("**/worker.js", async (route) => {
    const response = await route.fetch();
    const breaks = `const real = onmessage;
      onmessage = (event) => event.data.question.sheet === "break"
        ? postMessage({ number: event.data.number, broken: "a trap" })
        : real(event);`;
    await route.fulfill({ response, body: `${await response.text()}\n${breaks}` });
  });
  await page.reload();
  await says("No mistakes.");
  await until(0.3);
  await page.locator("#sheet").fill("break");
  await says("The solver was restarted: a trap");
  await page.waitForFunction(() => Number(document.getElementById("stage").dataset.time) < 0.3);
  await until(0.3);
});

test("a page without its module says so", async () => {
  await page.route("**/eem.wasm", (route) => route.fulfill({ status: 404 }));
  await page.reload();
  await says("The solver does not start: Error: eem.wasm: 404");
  // Chromium says it, too.
  said = said.filter((text) => !text.includes("404"));
});

for (const [width, colorScheme] of [[1280, "light"], [1280, "dark"], [390, "light"], [390, "dark"]]) {
  test(`pictures: ${width} pixels, ${colorScheme}`, async () => {
    await page.close();
    await open({ viewport: { width, height: 900 }, colorScheme, deviceScaleFactor: width < 500 ? 2 : 1 });
    await page.selectOption("#speed", "4");
    await until(11);
    const wide = await page.evaluate(() => document.scrollingElement.scrollWidth);
    assert.ok(wide <= width, `${wide} pixels in ${width}`);
    await page.screenshot({ path: `${pictures}/${width}-${colorScheme}.png`, fullPage: true });
  });
}
