// The nozzle travels along its stroke: played, dragged, or moved by keys.

const MOTION_STEP = 0.02; // of the stroke, per key press

class Travel {
    constructor(root, motion, nozzle, draw, say) {
        this.motion = motion;
        this.nozzle = nozzle;
        this.draw = draw;
        this.say = say;
        this.isPlaying = false;
        this.play = root.querySelector("[data-motion=play]");
        this.slider = root.querySelector("[data-motion=place]");
        this.shown = root.querySelector("[data-motion=shown]");
        const { at } = this.motion;
        [this.from, this.to] = [at[0], at[at.length - 1]];
        this.play.addEventListener("click", () => this.toggle());
        this.slider.addEventListener("input", () => {
            this.stop();
            this.show(Number(this.slider.value) / 1000);
        });
    }

    toggle() {
        if (this.isPlaying) {
            this.stop();
            return;
        }
        this.isPlaying = true;
        this.play.textContent = "\u23f8";
        this.play.setAttribute("aria-label", "Pause");
        this.say("The nozzle travels");
        let last = performance.now();
        const step = (now) => {
            if (!this.isPlaying) {
                return;
            }
            const share = this.share + (now - last) / 1000 / this.motion.seconds;
            last = now;
            this.show(share > 1 ? 0 : share);
            requestAnimationFrame(step);
        };
        requestAnimationFrame(step);
    }

    stop() {
        this.isPlaying = false;
        this.play.textContent = "\u25b6";
        this.play.setAttribute("aria-label", "Play");
    }

    move(step) {
        this.stop();
        this.show(Math.min(Math.max(this.share + step, 0), 1));
    }

    /** Puts the nozzle where it is after a share of the way. */
    show(share) {
        this.share = share;
        this.slider.value = Math.round(1000 * share);
        const place = this.from + share * (this.to - this.from);
        const { at, exits, directions, bodies, stations } = this.motion;
        let next = at.findIndex((it) => it > place);
        next = next < 1 ? at.length - 1 : next;
        const way = at[next] - at[next - 1];
        const part = way > 0 ? (place - at[next - 1]) / way : 1;
        const between = (list) => vector(list[next - 1]).lerp(vector(list[next]), part);
        const exit = between(exits);
        const direction = between(directions).normalize();
        const tips = bodies[next].map((_, body) => between(bodies.map((tip) => tip[body])));
        this.nozzle.stand(exit, direction, tips);
        const nearest = stations.reduce((best, it) => (Math.abs(it.at - place) < Math.abs(best.at - place) ? it : best));
        this.shown.textContent = `${place.toFixed(1)} mm; at the station ${nearest.text}`;
        this.slider.setAttribute("aria-valuetext", `${place.toFixed(1)} mm`);
        this.draw();
    }
}
