// Puts the view together from the data in the page.

function startViewer() {
    // Without WebGL the still picture stays.
    if (!document.createElement("canvas").getContext("webgl2")) {
        return;
    }
    const scene = SCENE;
    for (const surface of scene.surfaces) {
        surface.isShown = true;
    }
    // Shown first: a canvas has no size before.
    document.documentElement.classList.add("has-view");
    const root = document.getElementById("viewer");
    const canvas = root.querySelector("canvas");
    const section = new Section(scene, scene.surfaces);
    const stage = new Stage(canvas, scene, section);
    const status = root.querySelector("[role=status]");
    const say = (text) => (status.textContent = text);
    const nozzle = new Nozzle(scene);
    fillStage(root, scene, stage, section, nozzle, say);
    const travel = scene.motion ? new Travel(root, scene.motion, nozzle, () => stage.draw(), say) : null;

    const showSection = connectSection(root, section, () => stage.draw());
    const resetAll = () => {
        section.switch(true);
        section.turn(section.best);
        showSection();
        stage.reset();
        say("View reset");
    };
    const toggleSection = () => {
        section.switch(!section.isOn);
        showSection();
        say(section.isOn ? "Section on" : "Section off");
    };
    const moveSection = (share) => {
        section.move(section.offset + share * (section.to - section.from));
        showSection();
    };
    const showAll = () => {
        stage.showAll();
        say("The whole part");
    };
    connectKeys(canvas, {
        ArrowLeft: () => stage.turn(1, 0),
        ArrowRight: () => stage.turn(-1, 0),
        ArrowUp: () => stage.turn(0, 1),
        ArrowDown: () => stage.turn(0, -1),
        "+": () => stage.zoom(0.88),
        "=": () => stage.zoom(0.88),
        "-": () => stage.zoom(1 / 0.88),
        "[": () => moveSection(-0.02),
        "]": () => moveSection(0.02),
        s: toggleSection,
        w: showAll,
        r: resetAll,
        ...(travel && {
            p: () => travel.toggle(),
            ",": () => travel.move(-MOTION_STEP),
            ".": () => travel.move(MOTION_STEP),
        }),
    });
    const buttons = { reset: resetAll, whole: showAll, in: () => stage.zoom(0.88), out: () => stage.zoom(1 / 0.88) };
    for (const button of root.querySelectorAll("button[data-do]")) {
        button.addEventListener("click", buttons[button.dataset.do]);
    }
    stage.reset();
    stage.fit();
    showSection();
    travel?.show(0.5);
}

/** Fills the world and the legend. */
function fillStage(root, scene, stage, section, nozzle, say) {
    const legend = root.querySelector(".legend");
    const add = (into, name, swatch, object, isShown = true) => {
        if (object) {
            object.visible = isShown;
            stage.world.add(object);
            const show = (shown) => {
                object.visible = shown;
                stage.draw();
            };
            into(name, swatch, show, isShown);
        }
    };
    const asTheyCome = scene.paths.filter((path) => !path.picked);
    const picked = scene.paths.filter((path) => path.picked);
    const shots = legendGroup(legend, asTheyCome.length === 1 ? "1 shot" : `${asTheyCome.length} shots as they come`);
    const { flights, breaks } = pathObjects(asTheyCome, stage.near);
    flights.forEach((lines, flight) => {
        const { name, colour } = LOOK.flights[flight];
        add(shots, name, { kind: "line", colour }, lines);
    });
    const dashes = { kind: "dashes", colour: LOOK.breaks };
    add(shots, "break a limit or miss", dashes, breaks);
    // So many would look as if they were the rule.
    const others = breaks ? `${picked.length} more that do, picked` : `${picked.length} picked that break a limit or miss`;
    add(shots, others, dashes, pathObjects(picked, stage.near).breaks, false);

    const impacts = legendGroup(legend, "Impacts, area of a dot: N*");
    const kinds = [
        [scene.hits, "on target, first hits", LOOK.hit],
        [scene.rebounds, "on other surfaces", LOOK.rebound],
    ];
    for (const [places, name, colour] of kinds) {
        if (places.impulse.length > 0) {
            const object = dots(places, scene.wanted, colour, stage.near);
            add(impacts, `${name} (${places.impulse.length})`, { kind: "dot", colour }, object);
        }
    }
    if ([...scene.hits.breaks, ...scene.rebounds.breaks].some((breaks) => breaks)) {
        const note = document.createElement("p");
        note.textContent = "Red with a dark rim: breaks a goal or a limit.";
        legend.lastElementChild.append(note);
    }

    const things = legendGroup(legend, "Nozzle and strips");
    add(things, "nozzle, to scale", { kind: "area", colour: LOOK.nozzle }, nozzle.group);
    if (scene.places.length > 0) {
        const marks = new Strips(root.querySelector(".marks"), scene, stage, say);
        things("test strips", { kind: "dot", colour: "#222222" }, (isShown) => marks.show(isShown));
    }

    const surfaces = legendGroup(legend, "Surfaces");
    let secondary = 0;
    for (const surface of scene.surfaces) {
        let colour = { target: LOOK.target, deflector: LOOK.deflector }[surface.role];
        let name = surface.name;
        if (surface.role === "target") {
            name += ", the target";
        } else if (surface.role === "deflector") {
            name += ", deflector";
        } else {
            colour = LOOK.surfaces[secondary % LOOK.surfaces.length];
            secondary += 1;
        }
        // The target is shown whole, and so is what moves with the nozzle.
        const planes = surface.role === "secondary" ? section.planes : [];
        const mesh = surfaceMesh(surface, colour, planes);
        stage.world.add(mesh);
        surfaces(name, { kind: "area", colour }, (isShown) => {
            mesh.visible = isShown;
            surface.isShown = isShown;
            section.update();
            stage.draw();
        });
    }
    stage.world.add(section.outline);
}

startViewer();
