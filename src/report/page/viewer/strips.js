// Numbered marks where test strips belong, in the view and in their table.

class Strips {
    constructor(root, scene, stage, say) {
        this.stage = stage;
        this.say = say;
        this.leaders = document.createElementNS("http://www.w3.org/2000/svg", "svg");
        root.append(this.leaders);
        this.marks = scene.places.map((place, index) => this.mark(root, place, index + 1));
        for (const button of document.querySelectorAll("[data-strip]")) {
            const number = Number(button.dataset.strip);
            button.hidden = false;
            button.addEventListener("click", () => {
                this.pick(number);
                stage.canvas.scrollIntoView({ block: "center" });
                stage.canvas.focus({ preventScroll: true });
            });
        }
        stage.afterDrawing.push(() => this.follow());
    }

    mark(root, place, number) {
        const button = document.createElement("button");
        button.type = "button";
        button.className = "strip-mark";
        button.textContent = number;
        button.title = place.text;
        button.setAttribute("aria-label", `Test strip ${number}: ${place.text}`);
        button.addEventListener("click", () => this.pick(number));
        const leader = document.createElementNS("http://www.w3.org/2000/svg", "path");
        this.leaders.append(leader);
        root.append(button);
        return { button, leader, place, point: vector(place.point) };
    }

    /** Marks stay beside where they belong while the view moves, and apart from each other. */
    follow() {
        const places = this.marks.map(({ point }) => this.stage.onCanvas(point));
        const labels = apart(places.map(([x, y]) => [x, y - 26]));
        this.marks.forEach(({ button, leader }, index) => {
            const [[x, y], [labelX, labelY]] = [places[index], labels[index]];
            button.style.transform = `translate(${labelX.toFixed(1)}px, ${labelY.toFixed(1)}px)`;
            leader.setAttribute("d", `M${x.toFixed(1)},${y.toFixed(1)}L${labelX.toFixed(1)},${labelY.toFixed(1)}`);
        });
    }

    show(isShown) {
        this.leaders.style.display = isShown ? "" : "none";
        for (const { button } of this.marks) {
            button.hidden = !isShown;
        }
    }

    pick(number) {
        const { place } = this.marks[number - 1];
        for (const [index, { button }] of this.marks.entries()) {
            button.classList.toggle("picked", index + 1 === number);
        }
        for (const row of document.querySelectorAll("tr[data-strip-row]")) {
            row.classList.toggle("picked", Number(row.dataset.stripRow) === number);
        }
        this.say(`Test strip ${number} on ${place.surface}: ${place.text}`);
    }
}

/** Moves places apart, px, until none covers another. */
function apart(places) {
    const least = 25;
    const moved = places.map((place) => [...place]);
    for (let round = 0; round < 40; round += 1) {
        for (let one = 0; one < moved.length; one += 1) {
            for (let other = 0; other < one; other += 1) {
                const dx = moved[one][0] - moved[other][0];
                const dy = moved[one][1] - moved[other][1];
                const distance = Math.hypot(dx, dy);
                if (distance < least) {
                    const push = (least - distance) / 2;
                    // Marks at one place part sideways.
                    const [ux, uy] = distance > 0.5 ? [dx / distance, dy / distance] : [1, 0];
                    moved[one] = [moved[one][0] + ux * push, moved[one][1] + uy * push];
                    moved[other] = [moved[other][0] - ux * push, moved[other][1] - uy * push];
                }
            }
        }
    }
    return moved;
}
