// The data of the page, and how large things are drawn.

const SCENE = JSON.parse(document.getElementById("scene").textContent);

const LOOK = {
    ...SCENE.look,
    background: "#f4f6f8",
    pathWidth: 1.5, // px
    breakWidth: 2.6, // px
    sectionWidth: 2.2, // px
    dot: 0.009, // diameter of a dot with the wanted impulse, relative to what is in view
};
