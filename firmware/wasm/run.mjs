// Runs the module that is given and prints what it prints: node wasm/run.mjs MODULE
import { readFileSync } from "node:fs";

const decoder = new TextDecoder();
let text = "";
const env = {
    print: (start, length) => {
        text += decoder.decode(new Uint8Array(instance.exports.memory.buffer, start, length));
    },
};
const { instance } = await WebAssembly.instantiate(readFileSync(process.argv[2]), { env });
const well = instance.exports.run();
process.stdout.write(text);
process.exitCode = well ? 0 : 1;
