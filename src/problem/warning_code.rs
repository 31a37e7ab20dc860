//! The reasons for which something in a problem file can hardly be meant, one by one.

use super::fault_code::listed;

listed! {
    /// What can hardly be meant. Every warning carries one, so that a test can tell which of them
    /// the files in `tests/doubtful` have raised.
    pub enum WarningCode {
        /// All weights are 0.
        NothingWeighs,
        /// More impulse is wanted than the shot gives.
        ImpulseTooLarge,
        /// Far less impulse is wanted than the shot gives.
        ImpulseTooSmall,
        /// A hit that gives nothing is within the tolerance.
        LooseTolerance,
        /// A limit that friction cannot break.
        LimitBeyondFriction,
        /// A rebound may give more than the target shall receive.
        AllowanceAboveTarget,
        /// Rebounds are limited but not followed.
        ReboundsNotFollowed,
        /// No shot has this density.
        UnusualDensity,
        /// Shot as fine as dust.
        Dust,
        /// Shot as large as balls.
        Balls,
        /// A stroke whose feed nothing tells.
        FeedUnknown,
        /// The shot does not fit through the exit.
        ExitTooSmall,
        /// The part with the target is smaller than the shot.
        PartSmallerThanShot,
        /// The part with the target is far too large for the shot.
        PartFarTooLarge,
        /// A box that cuts nothing off.
        BoxTooLarge,
        /// The shot cannot touch the aim point.
        NoRoom,
        /// A part in another unit than the others.
        PartOfAnotherSize,
        /// A part far away from the others.
        PartFarAway,
        /// An exit far away from the scene.
        StandoffTooLong,
        /// Shifts that leave the target.
        AimOffTarget,
        /// The jet comes from inside a part.
        TargetInsideMaterial,
        /// No shot hits the target first.
        TargetOutOfSight,
        /// The nozzle fits nowhere.
        NozzleFitsNowhere,
    }
}
