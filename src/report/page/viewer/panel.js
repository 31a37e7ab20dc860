// What stands beside the view: a legend that shows and hides, the section plane, buttons.

/** A part of the legend with a box for each thing that can be hidden. */
function legendGroup(parent, title) {
    const group = document.createElement("fieldset");
    const legend = document.createElement("legend");
    legend.textContent = title;
    group.append(legend);
    return (name, swatch, show, isShown = true) => {
        // A title alone would say nothing.
        if (!group.parentElement) {
            parent.append(group);
        }
        const label = document.createElement("label");
        const box = document.createElement("input");
        box.type = "checkbox";
        box.checked = isShown;
        box.addEventListener("change", () => show(box.checked));
        const sample = document.createElement("span");
        sample.className = `swatch ${swatch.kind}`;
        sample.style.setProperty("--colour", swatch.colour);
        const text = document.createElement("span");
        text.textContent = name;
        label.append(box, sample, text);
        group.append(label);
    };
}

/** Connects the controls of the section plane; answers with what shows its state. */
function connectSection(root, section, redraw) {
    const isOn = root.querySelector("[data-section=on]");
    const direction = root.querySelector("[data-section=direction]");
    const offset = root.querySelector("[data-section=offset]");
    const shown = root.querySelector("[data-section=shown]");
    const show = () => {
        isOn.checked = section.isOn;
        direction.value = section.direction;
        offset.min = section.from;
        offset.max = section.to;
        offset.step = (section.to - section.from) / 200 || 1;
        offset.value = section.offset;
        const text = `${section.offset.toFixed(1)} mm`;
        shown.textContent = text;
        offset.setAttribute("aria-valuetext", `${text} from the aim point`);
        direction.disabled = !section.isOn;
        offset.disabled = !section.isOn;
        redraw();
    };
    isOn.addEventListener("change", () => {
        section.switch(isOn.checked);
        show();
    });
    direction.addEventListener("change", () => {
        section.turn(direction.value);
        show();
    });
    offset.addEventListener("input", () => {
        section.move(Number(offset.value));
        show();
    });
    return show;
}

/** What each key does while the view has the focus. */
function connectKeys(canvas, actions) {
    canvas.addEventListener("keydown", (event) => {
        const action = actions[event.key];
        if (action && !event.ctrlKey && !event.metaKey && !event.altKey) {
            action();
            event.preventDefault();
        }
    });
}
