// The list of all systems.
const pages = await (await fetch("catalogue.json")).json();
const thousand = { title: "A thousand double pendulums", about: "They start a billionth of a radian apart." };
const entry = ({ title, about }, href) => {
    const item = document.createElement("li");
    const link = document.createElement("a");
    const text = document.createElement("p");
    link.href = href;
    link.textContent = title;
    text.textContent = about;
    item.append(link, text);
    return item;
};
document.getElementById("systems").append(
    ...pages.map((page) => entry(page, `system.html?${page.name}`)),
    entry(thousand, "thousand.html"),
);
