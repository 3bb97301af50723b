// Parameters and state of a system as the end of an address: #p=parameters&x=coordinates and velocities.
// Numbers keep all digits. What is missing, or has the wrong number of numbers, is null.
const numbers = (text) => (text ? text.split(",").map(Number) : []);

export function read(page) {
    const parts = new URLSearchParams(location.hash.slice(1));
    const [parameters, state] = [numbers(parts.get("p")), numbers(parts.get("x"))];
    const sound = (list, length) => list.length === length && list.every(Number.isFinite);
    return {
        parameters: sound(parameters, page.parameters.length) ? parameters : null,
        state: sound(state, 2 * page.coordinates) ? state : null,
    };
}

export function written(page, parameters, module) {
    const state = Array.from({ length: 2 * page.coordinates }, (_, index) => module.number(index));
    return `#p=${parameters.join(",")}&x=${state.join(",")}`;
}
